#include "io/matrix_market.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <vector>

#include "io/errors.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator {

namespace {

constexpr std::uintmax_t most_bytes = 4'000'000'000;
constexpr long most_rows = 2'000'000;
constexpr std::streamsize longest_line = 1024;

enum class Half { none, symmetric, skew };

/** A file being read line by line, without comments and blank lines. */
class Lines {
public:
  explicit Lines(const std::string& file)
      : file_(file), in_(open_file(file, "a Matrix Market file", most_bytes))
  {
  }

  /** False at the end of the file. */
  bool next(bool with_comments = false)
  {
    char line[longest_line];
    do {
      if (!in_.getline(line, longest_line) && in_.gcount() == 0) return false;
      ++number_;
      if (in_.fail() && !in_.eof()) fail("is longer than a line of numbers");
      text_ = line;
      at_ = text_.data();
    } while (!with_comments && (text_[0] == '%' || is_at_end()));
    return true;
  }

  /** The words of the line, in small letters. */
  std::vector<std::string> words() const
  {
    std::string lower = text_;
    for (char& c : lower)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::istringstream in(lower);
    std::vector<std::string> list;
    for (std::string word; in >> word;) list.push_back(word);
    return list;
  }

  long whole(const char* what, long least, long most)
  {
    long value = 0;
    read(value, "a whole number");
    if (value < least || value > most)
      fail(format("%s must be in %ld...%ld, got %ld", what, least, most, value));
    return value;
  }

  double real()
  {
    double value = 0;
    read(value, "a number");
    if (!std::isfinite(value)) fail("holds a number that is not finite");
    return value;
  }

  void end_line()
  {
    if (!is_at_end()) fail("holds more than it should");
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw BadInput(
        format("%s:%ld: %s", file_.c_str(), std::max(1L, number_), problem.c_str()));
  }

private:
  bool is_at_end()
  {
    while (*at_ != '\0' && std::isspace(static_cast<unsigned char>(*at_))) ++at_;
    return *at_ == '\0';
  }

  template <class Number>
  void read(Number& value, const char* what)
  {
    const char* end = text_.data() + text_.size();
    if (is_at_end()) fail(std::string("lacks ") + what);
    if (*at_ == '+') ++at_;
    const auto [rest, error] = std::from_chars(at_, end, value);
    if (error != std::errc{} || (rest != end && !std::isspace(*rest)))
      fail(std::string("holds something else than ") + what);
    at_ = rest;
  }

  std::string file_, text_;
  std::ifstream in_;
  const char* at_ = nullptr;
  long number_ = 0;
};

/** What the first line says. */
struct Kind {
  bool in_full;
  Half half;
};

Kind kind_of(Lines& lines)
{
  const std::vector<std::string> words =
      lines.next(true) ? lines.words() : std::vector<std::string>{};
  const auto is_one_of = [&](std::size_t k, const std::vector<std::string>& known) {
    return std::ranges::find(known, words[k]) != known.end();
  };
  if (words.size() != 5 || words[0] != "%%matrixmarket" || words[1] != "matrix" ||
      !is_one_of(2, {"coordinate", "array"}) || !is_one_of(3, {"real", "integer"}) ||
      !is_one_of(4, {"general", "symmetric", "skew-symmetric"}))
    lines.fail(
        "must be %%MatrixMarket matrix, coordinate or array, real or integer, "
        "general, symmetric or skew-symmetric; not pattern, complex or hermitian");
  return {words[2] == "array", words[4] == "general"     ? Half::none
                               : words[4] == "symmetric" ? Half::symmetric
                                                         : Half::skew};
}

}  // namespace

SparseMatrix read_matrix(const std::string& file)
{
  Lines lines(file);
  const auto bytes = static_cast<double>(std::filesystem::file_size(file));
  const auto [in_full, half] = kind_of(lines);
  if (!lines.next()) lines.fail("the line with the sizes is missing");
  const long rows = lines.whole("the number of rows", 1, most_rows);
  if (lines.whole("the number of columns", 1, most_rows) != rows)
    lines.fail("the matrix must be square");
  const long below = rows * (rows - 1) / 2;
  const long stored =
      below + (half == Half::none ? below : 0) + (half == Half::skew ? 0 : rows);
  const long count =
      in_full ? stored : lines.whole("the number of entries", 0, 2'000'000'000);
  lines.end_line();
  /** "0\n" is the shortest number in full, "1 1 0\n" the shortest entry; the last needs no end of line. */
  const double least = (in_full ? 2.0 : 6.0) * static_cast<double>(count);
  if (count > stored || least > bytes + 1)
    lines.fail("announces more entries than the matrix or the file can hold");

  std::vector<Eigen::Triplet<double, int>> entries;
  long row = half == Half::skew ? 1 : 0, column = 0;  // of the next one in full
  for (long k = 0; k < count; ++k) {
    if (!lines.next())
      lines.fail(format("the file ends after %ld of %ld entries", k, count));
    if (!in_full) {
      row = lines.whole("row", 1, rows) - 1;
      column = lines.whole("column", 1, rows) - 1;
    }
    const double value = lines.real();
    lines.end_line();
    const int i = static_cast<int>(row), j = static_cast<int>(column);
    if (half == Half::skew && i == j && value != 0)
      lines.fail("a skew-symmetric matrix has no diagonal");
    if (value != 0 || !in_full) entries.emplace_back(i, j, value);
    if ((value != 0 || !in_full) && half != Half::none && i != j)
      entries.emplace_back(j, i, half == Half::skew ? -value : value);
    if (++row < rows || !in_full) continue;
    ++column;
    row = half == Half::none ? 0 : column + (half == Half::skew);
  }
  if (lines.next()) lines.fail("the matrix has ended before this line");
  SparseMatrix matrix(static_cast<int>(rows), static_cast<int>(rows));
  bool is_repeated = false;
  matrix.setFromTriplets(entries.begin(), entries.end(), [&](double a, double) {
    is_repeated = true;
    return a;
  });
  if (is_repeated)
    throw BadInput(file +
                   ": an entry is given twice (of a symmetric matrix one "
                   "triangle is given)");
  return matrix;
}

std::string matrix_text(const SparseMatrix& matrix)
{
  std::string text =
      format("%%%%MatrixMarket matrix coordinate real general\n%ld %ld %ld\n",
             static_cast<long>(matrix.rows()), static_cast<long>(matrix.cols()),
             static_cast<long>(matrix.nonZeros()));
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      text += format("%d %d %.17g\n", static_cast<int>(it.row()) + 1,
                     static_cast<int>(it.col()) + 1, it.value());
  return text;
}

}  // namespace rotor_stator
