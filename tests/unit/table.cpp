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

TEST_CASE("A table of numbers is read back, and a damaged one refused with its line")
{
  const std::string file = PROGRAM_DIR "/number_table_test.tsv";
  const auto written = [&](const std::string& content) {
    std::ofstream(file) << content;
    return NumberTable(file);
  };
  const NumberTable table = written("# a header\nf\tx\n1\t-2.5e-3\n\n3\t4\n");
  CHECK(table.rows() == 2);
  CHECK(table.at(0, "x") == -2.5e-3);
  CHECK(table.at(1, "f") == 3);
  CHECK_THROWS_AS(table.at(0, "y"), BadInput);
  CHECK_THROWS_WITH(written("f\tx\n1\n"), contains(":2: 1 cells, must be 2"));
  CHECK_THROWS_WITH(written("f\tx\n1\ta\n"), contains("'a' is not a finite number"));
  CHECK_THROWS_AS(written("f\tx\n"), BadInput);
  CHECK_THROWS_AS(NumberTable("no such file"), BadInput);
}
