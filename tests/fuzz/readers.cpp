/**
# Readers against a fuzzer

    FUZZ=matrix build/fuzz/readers -max_total_time=60 build/fuzz/matrix tests/fuzz

libFuzzer changes files so that they reach new code; the sanitizers watch. Whatever a file
holds, a reader gives what is in it or refuses it with one line: anything else ends the
run, and `crash-…` keeps the file. */
#include <sys/mman.h>
#include <unistd.h>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "io/errors.hpp"
#include "io/matrix_market.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "model/read_machine.hpp"

using namespace rotor_stator;

namespace {

void require(bool holds)
{
  if (!holds) std::abort();
}

/** A file in memory with this content. */
std::string file_with(const std::string& content)
{
  static const int file = memfd_create("fuzz", 0);
  require(ftruncate(file, 0) == 0 && pwrite(file, content.data(), content.size(), 0) ==
                                         static_cast<ssize_t>(content.size()));
  return "/proc/self/fd/" + std::to_string(file);
}

/** What a machine says of itself is a table, and as JSON too. */
void read_one_machine(const std::string& text)
{
  const Parameters machine = read_machine(StrictToml("machine.toml", text));
  Table table("machine", {{"x", "-", "none"}});
  describe(table, machine);
  require(nlohmann::json::parse(table.text(TableFormat::json))["schema"] == schema);
}

void read_scene(const std::string& text)
{
  SceneFile scene(file_with(text), "exchanged");
  const std::vector<std::string> keys = scene.toml().keys();
  for (const std::string& key : keys)
    for (const std::function<void()>& read : std::vector<std::function<void()>>{
             [&] { scene.speed_range(key); }, [&] { scene.toml().numbers(key, {}); },
             [&] {
               scene.toml().with({{key + ".x", 1}}).integers(key, 0, 9);
             },
             [&] { scene.data_sets(key); }})
      try {
        read();
      } catch (const BadInput&) {
      }
}

/** What was read and is written is read again. */
void read_one_matrix(const std::string& text)
{
  const SparseMatrix matrix = read_matrix(file_with(text));
  require(read_matrix(file_with(matrix_text(matrix))).isApprox(matrix, 1e-15));
}

void read_table(const std::string& text)
{
  const std::string file = file_with(text);
  writer_of_other_schema(file);
  const NumberTable table(file);
  for (std::size_t k = 0; k < table.rows(); ++k)
    require(table.row(k).size() == table.names().size());
}

/** Any text in a title, a note and a cell is text for a reader of JSON. */
void write_json(const std::string& text)
{
  Table table(text, {{"x", "-", text}, {"word", "word", ""}});
  table.parameters(text);
  table.row({1e-300, text});
  table.note("end");
  const auto read = nlohmann::json::parse(table.text(TableFormat::json));
  require(read["rows"].size() == 1 && read["header"].size() == 6 &&
          read["values"].empty());
}

const std::map<std::string, void (*)(const std::string&)> readers{
    {"machine", read_one_machine},
    {"scene", read_scene},
    {"matrix", read_one_matrix},
    {"table", read_table},
    {"json", write_json}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const auto read = readers.at(std::getenv("FUZZ"));
  try {
    read({reinterpret_cast<const char*>(data), size});
  } catch (const BadInput&) {
  } catch (const NoSolution&) {
  }
  return 0;
}
