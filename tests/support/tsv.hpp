/**
# Reading the project's tables */
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rotor_stator::tests
{

struct Tsv {
  std::vector<std::string> header;  ///< the lines that start with #
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  std::size_t index(const std::string& name) const;  ///< throws if there is none
  bool has(const std::string& name) const;
  double number(std::size_t row, const std::string& name) const;
  std::vector<double> column(const std::string& name) const;
};

Tsv parse_tsv(const std::string& text);

}  // namespace rotor_stator::tests
