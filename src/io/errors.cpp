#include "io/errors.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace rotor_stator {

std::string format(const char* pattern, ...)
{
  std::va_list arguments;
  va_start(arguments, pattern);
  std::va_list copy;
  va_copy(copy, arguments);
  std::string result(std::vsnprintf(nullptr, 0, pattern, copy), '\0');
  va_end(copy);
  std::vsnprintf(result.data(), result.size() + 1, pattern, arguments);
  va_end(arguments);
  return result;
}

std::string printable(const std::string& text)
{
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto next = [&](const char* bytes) { return text.compare(k, 3, bytes) == 0; };
    const bool ends_line = next("\xe2\x80\xa8") || next("\xe2\x80\xa9");
    const auto byte = static_cast<unsigned char>(text[k]);
    const bool control = byte < ' ' || byte == 0x7f;
    const bool high_control = byte == 0xc2 && k + 1 < text.size() &&
                              static_cast<unsigned char>(text[k + 1]) < 0xa0;
    out += control || high_control || ends_line ? format("\\x%02x", byte)
                                                : std::string(1, text[k]);
  }
  return out;
}

std::string joined(const std::vector<std::string>& words, const std::string& between)
{
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : between) + word;
  return line;
}

namespace {

/** What has to be put in, left out or changed to make one word of the other, in any case:
    4 for a character, 3 for two that change places. */
std::size_t edits(const std::string& a, const std::string& b)
{
  const auto same = [&](std::size_t i, std::size_t j) {
    const unsigned char one = a[i], other = b[j];
    return std::tolower(one) == std::tolower(other);
  };
  std::vector<std::size_t> last(b.size() + 1), row(last), next(last);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = 4 * j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = 4 * (i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j + 1] =
          std::min({row[j] + (same(i, j) ? 0 : 4), row[j + 1] + 4, next[j] + 4});
      if (i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j))
        next[j + 1] = std::min(next[j + 1], last[j - 1] + 3);
    }
    last.swap(row);
    row.swap(next);
  }
  return row.back();
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& known)
{
  std::string nearest;
  std::size_t least = 1000;
  for (const std::string& candidate : known) {
    const bool is_part = word.size() >= 4 && candidate.find(word) != std::string::npos;
    const std::size_t distance = edits(word.substr(0, 100), candidate);
    if (candidate == word || distance + !is_part >= least ||
        !(is_part || 3 * distance <= 4 * candidate.size()))
      continue;
    nearest = candidate;
    least = distance + !is_part;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

const char* after_plus(const std::string& word)
{
  return word.data() + (word[0] == '+' && word[1] != '-');
}

std::optional<double> decimal(const std::string& word)
{
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(after_plus(word), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace rotor_stator
