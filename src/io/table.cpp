#include "io/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <utility>

#include "io/errors.hpp"
#include "source_revision.hpp"

namespace rotor_stator {

std::string source_revision()
{
  return ROTOR_STATOR_REVISION;
}

std::string compiler()
{
#ifdef __clang__
  return __VERSION__ " " ROTOR_STATOR_FLAGS;
#else
  return "g++ " __VERSION__ " " ROTOR_STATOR_FLAGS;
#endif
}

namespace {

/** As %.15g writes a number, five times as fast. */
std::string fifteen_digits(double number)
{
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, number, std::chars_format::general, 15);
  return {text, end.ptr};
}

std::string joined(const std::vector<std::string>& words, char separator = '\t')
{
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : std::string(1, separator)) + word;
  return line;
}

/** In quotes; the sign doubled or escaped, and within JSON the backslash too. */
std::string quoted(const std::string& word, bool is_json = true)
{
  std::string out = "\"";
  for (char c : word) {
    if (c == '"' || (is_json && c == '\\')) out += is_json ? '\\' : '"';
    out += c;
  }
  return out + "\"";
}

/** The numbers of a header line by name: "rotor: m = 40 kg" gives rotor.m, "budget: 8 of" gives budget. */
void add_values(const std::string& line, std::map<std::string, std::string>& values)
{
  static const std::regex pattern(
      R"((?:^|[;,]) *(?:([^:;,=]+): )?(?:([^:;,=]+) = )?([-+.0-9e]*)[^:;,=]*)");
  std::string whose;
  for (std::sregex_iterator at(line.begin(), line.end(), pattern), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if ((*at)[1].matched) whose = (*at)[1];
    const auto number = decimal((*at)[3]);
    if (!number || (name.empty() && !(*at)[1].matched)) continue;
    values.emplace(whose + (whose.empty() || name.empty() ? "" : ".") + name,
                   fifteen_digits(*number));
  }
}

}  // namespace

bool Cell::is_finite() const
{
  const auto* number = std::get_if<double>(&value_);
  return !number || std::isfinite(*number);
}

std::string Cell::text(TableFormat form) const
{
  if (const auto* number = std::get_if<double>(&value_)) return fifteen_digits(*number);
  const std::string word = printable(std::get<std::string>(value_));
  if (form == TableFormat::json) return quoted(word);
  const bool is_plain =
      form == TableFormat::tsv || word.find_first_of(",\"") == std::string::npos;
  return is_plain ? word : quoted(word, false);
}

Table::Table(std::string what, std::vector<Column> columns) : columns_(std::move(columns))
{
  choose("all", 0, false);
  note(what);
  note("source: " + source_revision());
  note("compiler: " + compiler());
}

bool Table::choose(const std::string& names, std::size_t usual, bool is_drawn)
{
  printed_.clear();
  wanted_.assign(columns_.size(), false);
  const bool is_list = !names.empty() && names != "all";
  for (std::size_t k = 0; !is_list && k < (names.empty() ? usual : columns_.size()); ++k)
    printed_.push_back(k);
  std::istringstream in(is_list ? names : "");
  for (std::string name; std::getline(in, name, ',');) {
    printed_.push_back(static_cast<std::size_t>(
        std::ranges::find(columns_, name, &Column::name) - columns_.begin()));
    if (const std::size_t k = printed_.back(); k < columns_.size() && !wanted_[k]) {
      wanted_[k] = true;
      continue;
    }
    std::string known;
    for (const Column& column : columns_) known += " " + column.name;
    throw BadInput("--columns " + name + ": must be all, or of" + known + ", each once");
  }
  drawn_ = printed_;
  for (std::size_t k : printed_) wanted_[k] = true;
  for (std::size_t k = 0; is_drawn && k < usual; ++k)
    if (!wanted_[k]) drawn_.push_back(k);
  for (std::size_t k : drawn_) wanted_[k] = true;
  return *std::max_element(drawn_.begin(), drawn_.end()) >= usual;
}

void Table::note(const std::string& line)
{
  header_.push_back("# " + printable(line) + "\n");
}

void Table::row(std::vector<Cell> cells)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].is_finite())
      throw NoSolution("the result " + columns_.at(k).name + " is not finite");
  rows_.push_back(std::move(cells));
}

void Table::gap()
{
  if (!rows_.empty() && !rows_.back().empty()) rows_.emplace_back();
}

std::string Table::body(TableFormat format, const std::vector<std::size_t>& places) const
{
  const char separator = format == TableFormat::tsv ? '\t' : ',';
  const bool is_json = format == TableFormat::json;
  std::vector<std::string> names;
  for (std::size_t k : places) names.push_back(columns_[k].name);
  std::string out = is_json ? "" : joined(names, separator) + "\n";
  for (const auto& row : rows_) {
    std::vector<std::string> words;
    for (std::size_t k : places)
      if (k < row.size()) words.push_back(row[k].text(format));
    if (format != TableFormat::tsv && words.empty()) continue;
    if (is_json)
      out += (out.empty() ? "\n[" : ",\n[") + joined(words, ',') + "]";
    else
      out += joined(words, separator) + "\n";
  }
  return out;
}

std::string Table::json() const
{
  std::vector<std::string> lines, values, columns;
  std::map<std::string, std::string> numbers;
  for (const std::string& line : header_) {
    lines.push_back(quoted(line.substr(2, line.size() - 3)));
    add_values(line.substr(2, line.size() - 3), numbers);
  }
  for (const auto& [name, value] : numbers) values.push_back(quoted(name) + ": " + value);
  for (std::size_t k : printed_) {
    const auto& [name, unit, meaning] = columns_[k];
    columns.push_back("{\"name\": " + quoted(name) + ", \"unit\": " + quoted(unit) +
                      ", \"meaning\": " + quoted(meaning) + "}");
  }
  return "{\"header\": [" + joined(lines, ',') + "],\n\"values\": {" +
         joined(values, ',') + "},\n\"columns\": [" + joined(columns, ',') +
         "],\n\"rows\": [" + body(TableFormat::json, printed_) + "]}\n";
}

std::string Table::text(TableFormat format, bool is_drawn) const
{
  if (format == TableFormat::json) return json();
  const auto& places = is_drawn ? drawn_ : printed_;
  std::string out;
  if (format == TableFormat::tsv) {
    for (const std::string& line : header_) out += line;
    for (std::size_t k : places)
      out += "# column: " + columns_[k].name + " [" + columns_[k].unit + "] " +
             columns_[k].meaning + "\n";
  }
  return out + body(format, places);
}

}  // namespace rotor_stator
