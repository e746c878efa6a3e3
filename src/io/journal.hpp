/**
# Long studies: in parallel, and not lost when interrupted

A study is a numbered list of independent pieces of work, each giving some records. The records of
a finished piece are appended to a journal at once, byte by byte; a run that finds the journal of the
same study goes on from it. The result does not depend on the number of threads. */
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "io/parallel.hpp"

namespace rotor_stator {

struct Study {
  std::string name;     ///< for the line of progress
  std::string journal;  ///< file; a new one is begun if its first line is not `stamp`
  std::string stamp;    ///< all that the records depend on, in one line
  std::size_t pieces;
};

/** The bytes that `work` gives for each piece, or those of the journal where their number is a
    multiple of `record`. */
std::vector<std::string> run_journal(
    const Study& study, std::size_t record,
    const std::function<std::string(std::size_t piece)>& work);

/** The records of all pieces in order. Throws what `work` throws. */
template <class Record>
std::vector<std::vector<Record>> run_study(
    const Study& study, const std::function<std::vector<Record>(std::size_t piece)>& work)
{
  static_assert(std::is_trivially_copyable_v<Record>);
  std::vector<std::vector<Record>> all;
  for (const std::string& bytes :
       run_journal(study, sizeof(Record), [&](std::size_t piece) {
         const std::vector<Record> records = work(piece);
         return std::string(reinterpret_cast<const char*>(records.data()),
                            records.size() * sizeof(Record));
       })) {
    all.emplace_back(bytes.size() / sizeof(Record));
    if (!bytes.empty()) std::memcpy(all.back().data(), bytes.data(), bytes.size());
  }
  return all;
}

/** Source revision, compiler and the text of files in one line, for a stamp. */
std::string stamp_of(const std::vector<std::string>& files);

}  // namespace rotor_stator
