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

/** A file without comments and blank lines, word by word in small letters. */
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
      words_.clear();
      words_.str({line, static_cast<std::size_t>(in_.gcount() - !in_.eof())});
    } while (!with_comments && (is_at_end() || words_.peek() == '%'));
    return true;
  }

  bool is_at_end() { return (words_ >> std::ws).eof(); }

  std::string word()
  {
    std::string word;
    words_ >> word;
    for (char& c : word)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
  }

  template <class Number>
  Number read(const std::string& what)
  {
    if (is_at_end()) fail("lacks " + what);
    std::string text = word();
    if (std::is_floating_point_v<Number>)
      std::ranges::replace(text, 'd', 'e');  // of Fortran
    const char* const end = text.data() + text.size();
    Number value = 0;
    const auto [rest, error] = std::from_chars(after_plus(text), end, value);
    if (error != std::errc{} || rest != end) fail("holds something else than " + what);
    return value;
  }

  long whole(const char* what, long least, long most)
  {
    const long value = read<long>("a whole number");
    if (value < least || value > most)
      fail(format("%s must be in %ld...%ld, got %ld", what, least, most, value));
    return value;
  }

  double real()
  {
    const double value = read<double>("a number");
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
  std::string file_;
  std::ifstream in_;
  std::istringstream words_;
  long number_ = 0;
};

/** What the first line says: whether the matrix is given in full; and 0, or where one
    triangle is given the sign of the other. */
std::pair<bool, int> kind_of(Lines& lines)
{
  std::string words[5];
  if (lines.next(true))
    for (std::string& word : words) word = lines.word();
  const auto& [banner, object, form, field, half] = words;
  if (!(lines.is_at_end() && banner == "%%matrixmarket" && object == "matrix" &&
        (form == "coordinate" || form == "array") &&
        (field == "real" || field == "integer") &&
        (half == "general" || half == "symmetric" || half == "skew-symmetric")))
    lines.fail(
        "must be %%MatrixMarket matrix, coordinate or array, real or integer, "
        "general, symmetric or skew-symmetric; not pattern, complex or hermitian");
  return {form == "array", half == "general" ? 0 : half == "symmetric" ? 1 : -1};
}

}  // namespace

SparseMatrix read_matrix(const std::string& file)
{
  Lines lines(file);
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, error));
  const auto [in_full, sign] = kind_of(lines);
  if (!lines.next()) lines.fail("the line with the sizes is missing");
  const long rows = lines.whole("the number of rows", 1, most_rows);
  if (lines.whole("the number of columns", 1, most_rows) != rows)
    lines.fail("the matrix must be square");
  const long stored = sign == 0 ? rows * rows : rows * (rows + sign) / 2;
  const long count =
      in_full ? stored : lines.whole("the number of entries", 0, 2'000'000'000);
  lines.end_line();
  /** "0\n" and "1 1 0\n" are the shortest; the last needs no end of line. */
  const double least = (in_full ? 2.0 : 6.0) * static_cast<double>(count);
  if (least > bytes + 1) lines.fail("announces more entries than the file can hold");

  std::vector<Eigen::Triplet<double, int>> entries;
  bool is_above = false, is_below = false;
  long row = sign < 0 ? 1 : 0, column = 0;  // of the next one in full
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
    if (sign < 0 && i == j && value != 0)
      lines.fail("a skew-symmetric matrix has no diagonal");
    if (value != 0 || !in_full) {
      is_above = is_above || i < j;
      is_below = is_below || i > j;
      if (sign != 0 && is_above && is_below)
        lines.fail("both triangles have entries; of a symmetric matrix one is given");
      entries.emplace_back(i, j, value);
      if (sign != 0 && i != j) entries.emplace_back(j, i, sign * value);
    }
    if (++row < rows || !in_full) continue;
    ++column;
    row = sign == 0 ? 0 : column + (sign < 0);
  }
  if (lines.next()) lines.fail("the matrix has ended before this line");
  SparseMatrix matrix(static_cast<int>(rows), static_cast<int>(rows));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::string matrix_text(const SparseMatrix& matrix)
{
  std::string text = format(
      "%%%%MatrixMarket matrix coordinate real general\n"
      "%% written by rotor_stator\n%ld %ld %ld\n",
      static_cast<long>(matrix.rows()), static_cast<long>(matrix.cols()),
      static_cast<long>(matrix.nonZeros()));
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      text += format("%d %d %.17g\n", static_cast<int>(it.row()) + 1,
                     static_cast<int>(it.col()) + 1, it.value());
  return text;
}

}  // namespace rotor_stator
