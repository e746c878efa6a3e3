#include "output/table.hpp"

#include <cmath>
#include <utility>

#include "model/errors.hpp"
#include "output/provenance.hpp"

namespace rotor_stator
{

namespace
{

std::string joined(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : "\t") + word;
  return line + "\n";
}

}  // namespace

bool Cell::is_printable() const
{
  const auto* number = std::get_if<double>(&value_);
  return !number || std::isfinite(*number);
}

std::string Cell::text() const
{
  if (const auto* word = std::get_if<std::string>(&value_)) return *word;
  return rotor_stator::text("%.15g", std::get<double>(value_));
}

Table::Table(std::string what, std::vector<Column> columns) : columns_(std::move(columns))
{
  note(what);
  note("source: " + source_revision());
  note("compiler: " + compiler());
}

void Table::note(const std::string& line)
{
  header_.push_back("# " + line + "\n");
}

void Table::describe(const Parameters& parameters)
{
  const auto body = [](const char* name, const Body& b) {
    return rotor_stator::text("%s: m = %.15g kg, omega_0 = %.15g rad/s, xi = %.15g", name,
                              b.mass, b.natural_frequency, b.damping_ratio);
  };
  const Bearing& bearing = parameters.bearing;
  note("parameters: " + parameters.file + " (" + parameters.title + ")");
  note("  " + body("stator", parameters.stator) + "; " + body("rotor", parameters.rotor));
  note(rotor_stator::text("  m_e e = %.15g kg m; g = %.15g m/s^2", parameters.unbalance,
                          parameters.gravity));
  note(rotor_stator::text(
      "  bearing: n = %d, K_H = %.15g N/m^1.5, delta = %.15g m, omega_cage/omega = %.15g",
      bearing.balls, bearing.contact_stiffness, bearing.clearance,
      bearing.cage_speed_ratio));
}

void Table::row(std::vector<Cell> cells)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].is_printable())
      throw NoSolution("the result " + columns_.at(k).name + " is not finite");
  rows_.push_back(std::move(cells));
}

void Table::gap()
{
  if (!rows_.empty() && !rows_.back().empty()) rows_.emplace_back();
}

std::string Table::text() const
{
  std::string out;
  for (const std::string& line : header_) out += line;
  std::vector<std::string> names;
  for (const Column& column : columns_) {
    out += "# column: " + column.name + " [" + column.unit + "] " + column.meaning + "\n";
    names.push_back(column.name);
  }
  out += joined(names);
  for (const auto& row : rows_) {
    std::vector<std::string> words;
    for (const Cell& cell : row) words.push_back(cell.text());
    out += words.empty() ? "\n" : joined(words);
  }
  return out;
}

}  // namespace rotor_stator
