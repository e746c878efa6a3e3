/**
# Tables of numbers, read back

What a program wrote and another continues from: `#` lines, a row of names, rows of numbers, separated by
tabs. */
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace rotor_stator {

/** The program that wrote a table whose `#` lines have another schema (`Table`), as
    "rotor_stator 0.1.0 e3918e7"; empty where they have this one, or say nothing. */
std::string writer_of_other_schema(const std::string& file);

class NumberTable {
public:
  /** Throws BadInput with file and line when it is missing, empty, cut off, longer than 1 GB or not such a
      table; with `first_line`, when it begins otherwise. */
  explicit NumberTable(const std::string& file, const std::string& first_line = "");

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return rows_.size(); }
  const std::vector<double>& row(std::size_t k) const { return rows_.at(k); }

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
};

}  // namespace rotor_stator
