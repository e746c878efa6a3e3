#include "io/table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "io/errors.hpp"
#include "io/toml_file.hpp"
#include "source_revision.hpp"

namespace rotor_stator {

std::string source_revision()
{
  return ROTOR_STATOR_REVISION;
}

namespace {

#ifdef __clang__
constexpr const char* compiler = __VERSION__ " " ROTOR_STATOR_FLAGS;
#else
constexpr const char* compiler = "g++ " __VERSION__ " " ROTOR_STATOR_FLAGS;
#endif

/** One of "rest", "45", "turns 2". */
bool is_value(const std::string& text)
{
  const auto blank = text.find(' ');
  return !text.empty() && text.find_first_of("\t\n") == std::string::npos &&
         (blank == std::string::npos || decimal(text.substr(blank + 1)));
}

}  // namespace

std::string Cell::text(TableFormat form) const
{
  if (is_number()) {
    char text[32];  // as %.15g writes it, five times as fast
    const auto end = std::to_chars(text, text + sizeof text, std::get<double>(value_),
                                   std::chars_format::general, 15);
    return {text, end.ptr};
  }
  const std::string word = printable(std::get<std::string>(value_));
  if (form == TableFormat::tsv || word.find_first_of(",\"") == word.npos) return word;
  return (std::ostringstream() << std::quoted(word, '"', '"')).str();
}

std::string one_word(std::string text)
{
  std::ranges::replace(text, ' ', '-');
  return text;
}

Table::Table(const std::string& what, std::vector<Column> columns)
    : columns_(std::move(columns))
{
  choose("all", 0, false);
  line(what);
  line("source: " + source_revision());
  line(std::string("compiler: ") + compiler);
  line(format("schema: %d", schema));
}

bool Table::choose(const std::string& names, std::size_t usual, bool is_drawn)
{
  printed_.clear();
  const bool is_list = !names.empty() && names != "all";
  if (!is_list) printed_.resize(names.empty() ? usual : columns_.size());
  std::iota(printed_.begin(), printed_.end(), 0);
  std::istringstream in(is_list ? names : "");
  for (std::string name; std::getline(in, name, ',');) {
    const auto k = static_cast<std::size_t>(
        std::ranges::find(columns_, name, &Column::name) - columns_.begin());
    if (k == columns_.size() || std::ranges::count(printed_, k) > 0) {
      std::string known;
      for (const Column& column : columns_) known += " " + column.name;
      throw BadInput("--columns " + name + ": must be all, or of" + known +
                     ", each once; others are in --help");
    }
    printed_.push_back(k);
  }
  asked_ = "# row asked:";
  for (std::size_t k : printed_) asked_ += " " + columns_[k].name;
  if (!is_list || !is_drawn) asked_.clear();
  drawn_ = printed_;
  for (std::size_t k = 0; is_drawn && k < usual; ++k)
    if (std::ranges::count(printed_, k) == 0) drawn_.push_back(k);
  wanted_.assign(columns_.size(), false);
  for (std::size_t k : drawn_) wanted_[k] = true;
  return !drawn_.empty() && std::ranges::max(drawn_) >= usual;
}

void Table::line(const std::string& text)
{
  (rows_.empty() && !write_ ? head_ : foot_) += "# " + printable(text) + "\n";
}

void Table::sentence(const std::string& text)
{
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c));
  };
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    while (!word.empty() && !is_letter(word.back())) word.pop_back();
    word.erase(0, word.find_first_not_of("+-(|"));
    if (word == "nan" || word == "inf")
      throw NoSolution("a number in a line of the header is not finite: " + text);
  }
  line(text);
}

void Table::value(const std::string& key, const Cell& value)
{
  if (!value.is_finite()) throw NoSolution("the value of " + key + " is not finite");
  const auto is_known = [&](const auto& one) { return one.first == key; };
  if (std::ranges::any_of(values_, is_known) || !is_value(value.text()))
    throw std::logic_error("header: " + key + ": " + value.text());
  values_.emplace_back(key, value);
  line(key + ": " + value.text());
}

void Table::row_line(const std::string& name, const std::vector<Cell>& cells)
{
  std::vector<std::string> words;
  for (const Cell& cell : cells) {
    if (!cell.is_finite()) throw NoSolution("a value of " + name + " is not finite");
    words.push_back(cell.text());
  }
  lists_.emplace_back(name, cells);
  line("row " + name + ": " + joined(words, " "));
}

void Table::row(std::vector<Cell> cells)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].is_finite())
      throw NoSolution("the result " + columns_.at(k).name + " is not finite");
  rows_.push_back(std::move(cells));
  if (write_) write_(row_text(rows_.back(), format_, printed_));
}

void Table::gap()
{
  if (!rows_.empty() && !rows_.back().empty()) rows_.emplace_back();
}

std::string Table::beginning(TableFormat format,
                             const std::vector<std::size_t>& places) const
{
  std::string out = format == TableFormat::tsv ? head_ : "";
  std::vector<std::string> names;
  for (std::size_t k : places) {
    names.push_back(columns_[k].name);
    if (format == TableFormat::tsv)
      out += "# column: " + columns_[k].name + " [" + columns_[k].unit + "] " +
             columns_[k].meaning + "\n";
  }
  return out + joined(names, format == TableFormat::tsv ? "\t" : ",") + "\n";
}

std::string Table::row_text(const std::vector<Cell>& row, TableFormat format,
                            const std::vector<std::size_t>& places) const
{
  std::vector<std::string> words;
  for (std::size_t k : places)
    if (k < row.size()) words.push_back(row[k].text(format));
  if (format == TableFormat::csv && words.empty()) return "";
  return joined(words, format == TableFormat::tsv ? "\t" : ",") + "\n";
}

void Table::stream(std::function<void(const std::string&)> write, TableFormat format)
{
  write_ = std::move(write);
  format_ = format;
  write_(beginning(format, printed_));
}

void Table::printed_row(const std::vector<Cell>& cells)
{
  std::vector<Cell> whole(columns_.size(), 0);
  for (std::size_t k = 0; k < cells.size(); ++k) whole[printed_[k]] = cells[k];
  row(std::move(whole));
}

void Table::end_stream() const
{
  if (format_ == TableFormat::tsv) write_(foot_);
}

std::string Table::json() const
{
  using Json = nlohmann::ordered_json;
  const auto of = [](const Cell& cell) {
    return cell.is_number() ? Json::parse(cell.text()) : Json(cell.text());
  };
  const auto list_of = [&](const std::vector<Cell>& cells) {
    Json list = Json::array();
    for (const Cell& cell : cells) list.push_back(of(cell));
    return list;
  };
  Json header = Json::array(), values = Json::object(), lists = values, columns = header,
       rows = header;
  std::istringstream lines(head_ + foot_);
  for (std::string line; std::getline(lines, line);) header.push_back(line.substr(2));
  for (const auto& [key, value] : values_) values[key] = of(value);
  for (const auto& [name, cells] : lists_) lists[name].push_back(list_of(cells));
  for (std::size_t k : printed_)
    columns.push_back({{"name", columns_[k].name},
                       {"unit", columns_[k].unit},
                       {"meaning", columns_[k].meaning}});
  for (const auto& row : rows_) {
    std::vector<Cell> cells;
    for (std::size_t k : printed_)
      if (k < row.size()) cells.push_back(row[k]);
    if (!cells.empty()) rows.push_back(list_of(cells));
  }
  const Json whole{{"schema", schema}, {"header", header},   {"values", values},
                   {"lists", lists},   {"columns", columns}, {"rows", rows}};
  return whole.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string Table::text(TableFormat format, bool is_drawn) const
{
  if (format == TableFormat::json) return json();
  const auto& places = is_drawn ? drawn_ : printed_;
  std::string out = beginning(format, places);
  for (const auto& row : rows_) out += row_text(row, format, places);
  if (format != TableFormat::tsv) return out;
  return out + foot_ + (is_drawn && !asked_.empty() ? asked_ + "\n" : "");
}

namespace {

/** Cells between tabs; between semicolons or commas words may stand in quotes, and
    between semicolons a comma is that of a number. */
std::vector<std::string> split(const std::string& line, char between)
{
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"' && between != '\t')
      is_quoted = !is_quoted;
    else if (c == between && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += c == ',' && between == ';' ? '.' : c;
  }
  if (cells.back().empty()) cells.pop_back();
  if (between != '\t')
    for (std::string& cell : cells) {
      cell.erase(cell.find_last_not_of(' ') + 1);
      cell.erase(0, cell.find_first_not_of(' '));
    }
  return cells;
}

/** Of the line of names. */
char separator_of(const std::string& names)
{
  for (const char c : {'\t', ';'})
    if (names.find(c) != names.npos) return c;
  return names.find(',') != names.npos ? ',' : '\t';
}

constexpr std::uintmax_t most_bytes = 1'000'000'000;

}  // namespace

std::string writer_of_other_schema(const std::string& file)
{
  std::ifstream in = open_file(file, "a table", std::uintmax_t{1} << 60);
  const std::string source = "# source: ";
  std::string writer;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    if (line.ends_with('\r')) line.pop_back();
    if (line == format("# schema: %d", schema)) return "";
    if (line.starts_with(source)) writer = line.substr(source.size());
  }
  return printable(writer);
}

NumberTable::NumberTable(const std::string& file, const std::string& first_line)
    : file_(file)
{
  std::ifstream in = open_file(file, "a table", most_bytes);
  const std::string begin = first_line.empty() ? "" : first_line + "\n";
  std::string line(begin.size(), ' ');
  in.read(line.data(), std::ssize(line));
  if (line != begin) {
    const std::string writer = writer_of_other_schema(file);
    throw BadInput(file + ":1: '" + first_line + "' is expected" +
                   (writer.empty() ? "" : "; it was written by " + writer));
  }
  in.clear();
  for (int number = first_line.empty() ? 1 : 2; std::getline(in, line); ++number) {
    if (in.eof() && !first_line.empty())
      throw BadInput(format("%s:%d: the line is cut off", file.c_str(), number));
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.ends_with('\r')) line.pop_back();
    if (const auto colon = line.find(": "); line.starts_with("# ") && colon != line.npos)
      header_[line.substr(2, colon - 2)] = line.substr(colon + 2);
    if (line.starts_with("# column: ") && line.find(" [word] ") != line.npos)
      words_.insert(line.substr(10, line.find(' ', 10) - 10));
    if (line.empty() || line.front() == '#') continue;
    if (names_.empty()) {
      between_ = separator_of(line);
      names_ = split(line, between_);
      auto sorted = names_;
      std::ranges::sort(sorted);
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end()) fail("has the column " + *twice + " twice");
      continue;
    }
    lines_.push_back(number);
    read_row(line);
  }
  if (rows_.empty()) fail("not a table with rows of numbers");
}

void NumberTable::read_row(const std::string& line)
{
  rows_.emplace_back();
  for (const std::string& cell : split(line, between_)) {
    const std::size_t column = rows_.back().size();
    if (between_ != '\t' && rows() == 1 && column < names_.size() && !decimal(cell))
      words_.insert(names_[column]);
    const bool word = column < names_.size() && words_.contains(names_[column]);
    const std::optional<double> value = word ? 0 : decimal(cell);
    if (!value) fail(rows() - 1, "'" + cell.substr(0, 40) + "' is not a finite number");
    rows_.back().push_back(*value);
  }
  if (rows_.back().size() != names_.size())
    fail(rows() - 1,
         format("%zu cells, must be %zu", rows_.back().size(), names_.size()));
}

double NumberTable::at(std::size_t row, const std::string& column) const
{
  const auto found = std::ranges::find(names_, column);
  if (found == names_.end() || words_.contains(column))
    fail("has no column " + column + " of numbers");
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

const std::vector<double>& NumberTable::row(std::size_t k) const
{
  if (!words_.empty()) fail("has no column " + *words_.begin() + " of numbers");
  return rows_.at(k);
}

const std::string& NumberTable::header(const std::string& key) const
{
  const auto found = header_.find(key);
  if (found == header_.end()) fail("the line '# " + key + ": ' is missing");
  return found->second;
}

void NumberTable::fail(const std::string& problem) const
{
  throw BadInput(file_ + ": " + problem);
}

void NumberTable::fail(std::size_t row, const std::string& problem) const
{
  throw BadInput(format("%s:%d: %s", file_.c_str(), lines_.at(row), problem.c_str()));
}

}  // namespace rotor_stator
