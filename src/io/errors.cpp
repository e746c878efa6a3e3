#include "io/errors.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numeric>

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

namespace {

/** How many characters have to be put in, left out or changed to make one word of the
    other. */
std::size_t edits(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& known)
{
  std::string nearest;
  std::size_t least = 100;
  for (const std::string& candidate : known) {
    const bool is_part = word.size() >= 4 && candidate.find(word) != std::string::npos;
    const std::size_t distance = edits(word.substr(0, 100), candidate);
    if (distance >= least || !(is_part || 3 * distance <= candidate.size())) continue;
    nearest = candidate;
    least = distance;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::optional<double> decimal(const std::string& word)
{
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace rotor_stator
