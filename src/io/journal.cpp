#include "io/journal.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>

#include "io/errors.hpp"
#include "io/table.hpp"

namespace rotor_stator {

namespace {

using Pieces = std::vector<std::optional<std::string>>;

/** The number of a piece and its bytes, in hexadecimal. */
std::string journal_line(std::size_t piece, const std::string& bytes)
{
  std::string line = std::to_string(piece) + " ";
  for (const unsigned char byte : bytes) line += format("%02x", byte);
  return line + "\n";
}

/** The pieces that a journal holds; none if it belongs to another study. A last line
   without an end was cut off while it was written, and does not count. */
Pieces read_journal(const Study& study, std::size_t record)
{
  Pieces pieces(study.pieces);
  std::ifstream in(study.journal);
  std::string line;
  if (!std::getline(in, line) || line != study.stamp) return pieces;
  while (std::getline(in, line) && !in.eof()) {
    std::istringstream words(line);
    std::size_t piece;
    std::string digits, bytes;
    if (!(words >> piece) || piece >= study.pieces) continue;
    words >> digits;
    if (digits.size() % (2 * record) != 0) continue;
    for (std::size_t k = 0; k < digits.size(); k += 2) {
      unsigned char byte = 0;
      std::from_chars(&digits[k], &digits[k] + 2, byte, 16);
      bytes += static_cast<char>(byte);
    }
    pieces[piece] = bytes;
  }
  return pieces;
}

/** The journal written anew beside the old one: the stamp and the pieces that are known. */
std::ofstream begin_journal(const Study& study, const Pieces& known)
{
  const std::string beside = study.journal + ".new";
  std::ofstream out(beside);
  out << study.stamp << "\n";
  for (std::size_t piece = 0; piece < known.size(); ++piece)
    if (known[piece]) out << journal_line(piece, *known[piece]);
  std::error_code error;
  if (out.flush()) std::filesystem::rename(beside, study.journal, error);
  if (!out || error) throw NoSolution(study.journal + ": cannot be written");
  return out;
}

}  // namespace

std::vector<std::string> run_journal(
    const Study& study, std::size_t record,
    const std::function<std::string(std::size_t piece)>& work)
{
  const Pieces known = read_journal(study, record);
  std::ofstream journal = begin_journal(study, known);
  std::mutex mutex;
  return computed_in_parallel(study.name, study.pieces, [&](std::size_t piece) {
    if (known[piece]) return *known[piece];
    const std::string bytes = work(piece);
    const std::lock_guard lock(mutex);
    journal << journal_line(piece, bytes) << std::flush;
    return bytes;
  });
}

std::string stamp_of(const std::vector<std::string>& files)
{
  std::string stamp = source_revision() + " " + compiler() + " ";
  for (const std::string& file : files) {
    std::ifstream in(file);
    for (std::string word; in >> word;) stamp += word + " ";
  }
  return stamp;
}

}  // namespace rotor_stator
