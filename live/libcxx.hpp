/** What the core uses of C++20 and the compiler of Debian 12 for the browser does not have yet (libc++ 13).
    Included before every source of the live page. */
#pragma once
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

#if _LIBCPP_VERSION < 15000
namespace std {

template <class To, class From>
To bit_cast(const From& from)
{
  To to;
  memcpy(&to, &from, sizeof to);
  return to;
}

/** Of decimal numbers: names such as inf and hexadecimal ones are refused. */
inline from_chars_result from_chars(const char* first, const char* last, double& value)
{
  string text(first, last);
  text = text.substr(0, text.find_first_not_of("+-.0123456789eE"));
  char* end = nullptr;
  value = strtod(text.c_str(), &end);
  return {first + (end - text.c_str()),
          end == text.c_str() ? errc::invalid_argument : errc()};
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format,
                                int digits)
{
  return {
      first + snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, value),
      errc()};
}

namespace ranges {

template <class Before, class Key>
auto by(Before before, Key key)
{
  return [=](const auto& a, const auto& b) {
    return before(invoke(key, a), invoke(key, b));
  };
}

#define WITH_ORDER(name)                                            \
  template <class Range, class Before = less, class Key = identity> \
  auto name(Range&& range, Before before = {}, Key key = {})        \
  {                                                                 \
    return std::name(begin(range), end(range), by(before, key));    \
  }
WITH_ORDER(sort)
WITH_ORDER(stable_sort)
WITH_ORDER(min_element)
WITH_ORDER(max_element)
WITH_ORDER(minmax_element)

#define WITH_TEST(name)                                                            \
  template <class Range, class Test, class Key = identity>                         \
  auto name(Range&& range, Test test, Key key = {})                                \
  {                                                                                \
    return std::name(begin(range), end(range),                                     \
                     [&](auto& item) { return invoke(test, invoke(key, item)); }); \
  }
WITH_TEST(find_if)
WITH_TEST(count_if)
WITH_TEST(all_of)
WITH_TEST(any_of)
WITH_TEST(none_of)
WITH_TEST(for_each)

#define WITH_VALUE(name)                                                             \
  template <class Range, class Value, class Key = identity>                          \
  auto name(Range&& range, const Value& value, Key key = {})                         \
  {                                                                                  \
    return name##_if(range, [&](auto& item) { return invoke(key, item) == value; }); \
  }
WITH_VALUE(find)
WITH_VALUE(count)

template <class Range, class Value, class Before = less, class Key = identity>
auto upper_bound(Range&& range, const Value& value, Before before = {}, Key key = {})
{
  return std::upper_bound(begin(range), end(range), value,
                          [&](const auto& bound, const auto& item) {
                            return invoke(before, bound, invoke(key, item));
                          });
}

template <class Range>
auto max(const Range& range)
{
  return *std::max_element(begin(range), end(range));
}

template <class Range, class Value>
void replace(Range&& range, const Value& old, const Value& value)
{
  std::replace(begin(range), end(range), old, value);
}

template <class Range, class Output>
void copy(Range&& range, Output output)
{
  std::copy(begin(range), end(range), output);
}

template <class Range, class Output, class Change>
void transform(Range&& range, Output output, Change change)
{
  std::transform(begin(range), end(range), output, change);
}

template <class Range, class Other>
auto mismatch(const Range& range, const Other& other)
{
  return std::mismatch(begin(range), end(range), begin(other), end(other));
}

template <class Range, class Output>
void move(Range&& range, Output output)
{
  std::move(begin(range), end(range), output);
}

template <class Range>
void reverse(Range&& range)
{
  std::reverse(begin(range), end(range));
}

}  // namespace ranges
}  // namespace std
#endif
