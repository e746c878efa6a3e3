/**
# Headers of tables

What is a key, what is a sentence, and where it stands. */
#include "io/table.hpp"
#include <fstream>
#include <limits>
#include "support/cases.hpp"

using namespace rotor_stator;

TEST_CASE("A table keeps keys, lists and notes apart, and has a footer")
{
  Table table("What it is", {{"x", "m", "place"}});
  table.parameters("machine.toml (a title: 3)");
  table.value("regime", "periodic");
  table.value("base", "turns 2");
  table.row_line("orders", {0, "3-5"});
  table.note("a sentence: 7");
  table.row({0.25});
  table.value("evaluations", 12345.0, 2);
  const std::string text = table.text();
  CHECK(text.find("\n# regime: periodic\n# base: turns 2\n# row orders: 0 3-5\n"
                  "# note: a sentence: 7\n# column: x [m] place\nx\n0.25\n"
                  "# evaluations: 12000\n") != std::string::npos);
  CHECK(table.text(TableFormat::csv) == "x\n0.25\n");
  CHECK(
      table.text(TableFormat::json)
          .find(R"("values":{"regime":"periodic","base":"turns 2","evaluations":12000},)"
                R"("lists":{"orders":[[0,"3-5"]]})") != std::string::npos);
}

TEST_CASE("A key has one finite value, of one word")
{
  Table table("What it is", {{"x", "m", "place"}});
  table.value("period", 2);
  CHECK_THROWS_AS(table.value("period", 2), std::logic_error);
  CHECK_THROWS_AS(table.value("regime", "not periodic"), std::logic_error);
  CHECK_THROWS_AS(table.value("error_rms", std::numeric_limits<double>::infinity()),
                  NoSolution);
  CHECK_THROWS_AS(table.row_line("list", {std::numeric_limits<double>::quiet_NaN()}),
                  NoSolution);
  for (const char* text : {"reached -nan, of 3", "at (inf; 2)", "error nan%"})
    CHECK_THROWS_AS(table.note(text), NoSolution);
  CHECK_THROWS_AS(table.detail("delta = nan m"), NoSolution);
  CHECK_NOTHROW(table.note("of 'nan.tsv', infinite, info"));
}
