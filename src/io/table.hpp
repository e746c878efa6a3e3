/**
# Tables, written and read back

The source of a table is stamped when the library is compiled. A new commit alone triggers
no rebuild. */
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/errors.hpp"

namespace rotor_stator {

/** Name and version of the project and the revision of its source, with "-dirty" after
    uncommitted changes; "unknown" outside git. */
std::string source_revision();

/**
## What a table says about itself

Tab-separated text that describes itself. `#` lines stand before and after the rows:

    # Orbit of rotor and stator            what it is, source, compiler, `# parameters:`
    # frequency: 45                        a key and its value, a number or one word
    # row panel: 1 20 periodic             a list, a line for each of its members
    # note: no ball touches its race       a sentence, which no program reads
    # column: x_r [m] rotor                then one row of names and the numbers

Titles and names of files stand in `# parameters:` and notes alone, what is known only
after the rows in the footer. No dates, no host names: the same source, the same bytes. */

/** Of these lines and of the JSON; version 0.1.0 wrote sentences, schema 1. */
constexpr int schema = 2;

struct Column {
  std::string name, unit, meaning;
};

/** How a table is written: with its `#` lines; names and rows alone; all of it as one
    object, with the keys in `values` and the members of lists in `lists`. */
enum class TableFormat { tsv, csv, json };

/** A number or a word. */
class Cell {
public:
  Cell(double number) : value_(number) {}
  Cell(std::integral auto number) : value_(static_cast<double>(number)) {}
  Cell(std::string word) : value_(std::move(word)) {}
  Cell(const char* word) : value_(word) {}
  template <class Enum>
  requires std::is_enum_v<Enum> Cell(Enum number) : value_(static_cast<double>(number)) {}

  bool is_number() const { return std::holds_alternative<double>(value_); }
  bool is_finite() const
  {
    return !is_number() || std::isfinite(std::get<double>(value_));
  }
  /** 15 significant digits, or the word. */
  std::string text(TableFormat format = TableFormat::tsv) const;

private:
  std::variant<double, std::string> value_;
};

/** `text` as one word of a header: "quasi-static contact" as "quasi-static-contact". */
std::string one_word(std::string text);

/** A column with where its value stands in a row of type `Row`. */
template <class Row>
struct Field : Column {
  std::function<Cell(const Row&)> value;
};

/** One list of fields after the other. */
template <class Row>
std::vector<Field<Row>> operator+(std::vector<Field<Row>> all,
                                  const std::vector<Field<Row>>& more)
{
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/** Fields of x_s, y_s, x_r, y_r [m], the four numbers that are `value` of a row. */
template <class Row, class Value>
std::vector<Field<Row>> displacement_fields(const std::string& before,
                                            const std::string& meaning, Value value,
                                            const std::string& after = "")
{
  std::vector<Field<Row>> fields;
  for (std::size_t k = 0; const std::string name : {"x_s", "y_s", "x_r", "y_r"}) {
    fields.push_back({before + name + after, "m", meaning + name,
                      [=](const Row& row) { return std::invoke(value, row)[k]; }});
    ++k;
  }
  return fields;
}

class Table {
public:
  /** `what` is the first line of the header. */
  Table(const std::string& what, std::vector<Column> columns);

  /** Columns from a list of fields. */
  template <class Row>
  Table(const std::string& what, const std::vector<Field<Row>>& fields)
      : Table(what, std::vector<Column>(fields.begin(), fields.end()))
  {
  }

  /** Prints the columns that `names` lists, separated by commas; "all"; without it the
      first `usual`, of which a figure is drawn too. Whether others are wanted. Throws
      BadInput for another name. */
  bool choose(const std::string& names, std::size_t usual, bool is_drawn);

  /** Lines of the header before the first row, of the footer after it: what was modelled;
      its values in words; a key; a member of a list; a sentence. Throw NoSolution for a
      number that is not finite, std::logic_error for a key set twice or a value of
      several words. */
  void parameters(const std::string& source) { line("parameters: " + source); }
  void detail(const std::string& text) { sentence("  " + text); }

  /** What the user should know even where only rows are read: also for stderr. */
  void warning(const std::string& text)
  {
    detail("warning: " + text);
    warnings_.push_back(text);
  }
  const std::vector<std::string>& warnings() const { return warnings_; }

  void value(const std::string& key, const Cell& value);
  void value(const std::string& key, double number, int digits)
  {
    value(key, std::strtod(format("%.*g", digits, number).c_str(), nullptr));
  }
  void row_line(const std::string& name, const std::vector<Cell>& cells);
  void note(const std::string& text) { sentence("note: " + text); }

  /** Throws NoSolution if a number is not finite: no NaN is ever printed as a result. */
  void row(std::vector<Cell> cells);

  /** The row of `item`; what is not wanted is not computed. */
  template <class Row>
  void row(const std::vector<Field<Row>>& fields, const Row& item)
  {
    std::vector<Cell> cells;
    for (std::size_t k = 0; k < fields.size(); ++k)
      cells.push_back(wanted_[k] ? fields[k].value(item) : 0);
    row(std::move(cells));
  }

  /** A blank line: curves are drawn with a gap here. */
  void gap();

  /** For a figure with all columns. */
  std::string text(TableFormat format = TableFormat::tsv, bool is_drawn = false) const;

  /** From now on what is added goes to `write` at once, as tab-separated text or CSV: a
      run that is killed keeps its rows. `text` still has all of it. */
  void stream(std::function<void(const std::string&)> write, TableFormat format);

  /** The lines after the rows, to the stream. */
  void end_stream() const;

  /** All before the rows, of the printed columns; their number; and a row of them. */
  std::string beginning() const { return beginning(TableFormat::tsv, printed_); }
  std::size_t printed() const { return printed_.size(); }
  void printed_row(const std::vector<Cell>& cells);

private:
  void line(const std::string& text);
  void sentence(const std::string& text);
  std::string beginning(TableFormat format, const std::vector<std::size_t>& places) const;
  std::string row_text(const std::vector<Cell>& row, TableFormat format,
                       const std::vector<std::size_t>& places) const;
  std::string json() const;

  std::string head_, foot_;
  std::vector<std::string> warnings_;
  std::vector<std::pair<std::string, Cell>> values_;
  std::vector<std::pair<std::string, std::vector<Cell>>> lists_;
  std::vector<Column> columns_;
  std::vector<std::size_t> printed_, drawn_;  ///< their places
  std::string asked_;  ///< the line that tells a figure what `--columns` names
  std::vector<bool> wanted_;
  std::vector<std::vector<Cell>> rows_;                 ///< an empty row is a gap
  std::function<void(const std::string&)> write_ = {};  ///< where rows go at once
  TableFormat format_ = TableFormat::tsv;
};

/**
## Tables of numbers, read back

What a program wrote and another continues from. */

/** The program that wrote a table whose `#` lines have another schema (`Table`), as
    "rotor_stator 0.1.0 e3918e7"; empty where they have this one, or say nothing. */
std::string writer_of_other_schema(const std::string& file);

class NumberTable {
public:
  /** Separated by tabs, semicolons or commas, with the line ends and the byte order mark
      of any system; with a `first_line`, with which it must begin, as this program wrote
      it. Throws BadInput with file and line when it is missing, empty, longer than 1 GB
      or not such a table, with a first line also when it is cut off. */
  explicit NumberTable(const std::string& file, const std::string& first_line = "");

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return rows_.size(); }
  /** Throws BadInput if one of its columns has words. */
  const std::vector<double>& row(std::size_t k) const;

  /** Throws BadInput if there is no such column of numbers. */
  double at(std::size_t row, const std::string& column) const;

  /** The value of the line `# key: value`. Throws BadInput when it is missing. */
  const std::string& header(const std::string& key) const;

  /** Throws BadInput about a row, or about the whole file. */
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail(std::size_t row, const std::string& problem) const;

private:
  void read_row(const std::string& line);

  std::string file_;
  std::map<std::string, std::string> header_;
  std::vector<std::string> names_;
  std::set<std::string> words_;  ///< columns of words: 0 in all rows
  std::vector<std::vector<double>> rows_;
  std::vector<int> lines_;  ///< of the rows in the file
  char between_ = '\t';
};

}  // namespace rotor_stator
