#include "support/tsv.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace rotor_stator::tests
{

namespace
{

std::vector<std::string> cells(const std::string& line)
{
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
  return words;
}

}  // namespace

std::size_t Tsv::index(const std::string& name) const
{
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::runtime_error("no column " + name);
  return static_cast<std::size_t>(found - names.begin());
}

bool Tsv::has(const std::string& name) const
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

double Tsv::number(std::size_t row, const std::string& name) const
{
  return std::stod(rows.at(row).at(index(name)));
}

std::vector<double> Tsv::column(const std::string& name) const
{
  std::vector<double> values;
  for (std::size_t row = 0; row < rows.size(); ++row) values.push_back(number(row, name));
  return values;
}

Tsv parse_tsv(const std::string& text)
{
  Tsv tsv;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (line.front() == '#')
      tsv.header.push_back(line);
    else if (tsv.names.empty())
      tsv.names = cells(line);
    else
      tsv.rows.push_back(cells(line));
  }
  return tsv;
}

}  // namespace rotor_stator::tests
