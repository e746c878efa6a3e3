/** What the core uses of C++20 and the compiler of Debian 12 for the browser does not have yet (libc++ 13).
    Included before every source of the live page. */
#pragma once
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#if _LIBCPP_VERSION < 15000
namespace std {

template <class To, class From>
To bit_cast(const From& from)
{
  To to;
  memcpy(&to, &from, sizeof to);
  return to;
}

/** Of decimal numbers at the begin of a text; hexadecimal ones and names of no number are refused. */
inline from_chars_result from_chars(const char* first, const char* last, double& value)
{
  const string text(first, last);
  const size_t digits = text.find_first_not_of("+-.0123456789eE");
  char* end = nullptr;
  value = strtod(text.substr(0, digits).c_str(), &end);
  const auto used = end ? strlen(text.substr(0, digits).c_str()) - strlen(end) : 0;
  return {first + used, used > 0 ? errc() : errc::invalid_argument};
}

namespace views {

/** Eager: the values themselves. */
template <class Take>
struct Transform {
  Take take;
};
template <class Take>
Transform<Take> transform(Take take)
{
  return {take};
}
template <class Range, class Take>
auto operator|(const Range& range, const Transform<Take>& transform)
{
  vector<decay_t<decltype(transform.take(*range.begin()))>> values;
  for (const auto& item : range) values.push_back(transform.take(item));
  return values;
}

}  // namespace views

namespace ranges {

template <class Before, class Key>
auto by(Before before, Key key)
{
  return [=](const auto& a, const auto& b) {
    return before(invoke(key, a), invoke(key, b));
  };
}

template <class Range, class Before = less, class Key = identity>
void sort(Range&& range, Before before = {}, Key key = {})
{
  std::sort(begin(range), end(range), by(before, key));
}
template <class Range, class Before = less, class Key = identity>
void stable_sort(Range&& range, Before before = {}, Key key = {})
{
  std::stable_sort(begin(range), end(range), by(before, key));
}
template <class Range, class Before = less, class Key = identity>
auto min_element(Range&& range, Before before = {}, Key key = {})
{
  return std::min_element(begin(range), end(range), by(before, key));
}
template <class Range, class Before = less, class Key = identity>
auto max_element(Range&& range, Before before = {}, Key key = {})
{
  return std::max_element(begin(range), end(range), by(before, key));
}
template <class Range>
auto minmax(Range&& range)
{
  const auto [low, high] = std::minmax_element(begin(range), end(range));
  return pair(*low, *high);
}
template <class Range, class Test>
auto find_if(Range&& range, Test test)
{
  return std::find_if(begin(range), end(range), test);
}
template <class Range, class Value, class Key = identity>
auto find(Range&& range, const Value& value, Key key = {})
{
  return find_if(range, [&](const auto& item) { return invoke(key, item) == value; });
}
template <class Range, class Test>
auto count_if(Range&& range, Test test)
{
  return std::count_if(begin(range), end(range), test);
}
template <class Range, class Value, class Key = identity>
auto count(Range&& range, const Value& value, Key key = {})
{
  return count_if(range, [&](const auto& item) { return invoke(key, item) == value; });
}
template <class Range, class Test>
bool any_of(Range&& range, Test test)
{
  return std::any_of(begin(range), end(range), test);
}
template <class Range, class Test>
bool none_of(Range&& range, Test test)
{
  return !any_of(range, test);
}

}  // namespace ranges
}  // namespace std
#endif
