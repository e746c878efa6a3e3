#include "hard/fuzz_file.hpp"

#include <functional>
#include <utility>

namespace rotor_stator::tests
{

namespace
{

struct Entry {
  std::string table, key, value;
};
using File = std::vector<Entry>;

File good_file()
{
  return {{"", "title", "\"fuzz\""},
          {"stator", "mass_kg", "20.0"},
          {"stator", "natural_frequency_rad_per_s", "500.0"},
          {"stator", "damping_ratio", "0.05"},
          {"rotor", "mass_kg", "40.0"},
          {"rotor", "natural_frequency_rad_per_s", "150.0"},
          {"rotor", "damping_ratio", "0.02"},
          {"rotor", "unbalance_kg_m", "0.05"},
          {"bearing", "balls", "16"},
          {"bearing", "contact_stiffness_N_per_m1p5", "1e11"},
          {"bearing", "radial_clearance_m", "2e-5"},
          {"bearing", "cage_speed_ratio", "0.5"},
          {"gravity", "acceleration_m_per_s2", "9.81"}};
}

std::string written(const File& file)
{
  std::string content, table;
  for (const Entry& entry : file) {
    if (entry.table != table) content += "\n[" + entry.table + "]\n";
    table = entry.table;
    content += entry.key + " = " + entry.value + "\n";
  }
  return content;
}

std::string& value_of(File& file, const std::string& table, const std::string& key)
{
  for (Entry& entry : file)
    if (entry.table == table && entry.key == key) return entry.value;
  throw std::runtime_error("no such entry");
}

/** Values of every TOML type, at and beyond the limits of each. */
std::string odd_value(Dice& dice)
{
  static const std::vector<std::string> values{"nan",
                                               "+nan",
                                               "-nan",
                                               "inf",
                                               "-inf",
                                               "0",
                                               "-0",
                                               "0.0",
                                               "-0.0",
                                               "1",
                                               "-1",
                                               "1e308",
                                               "-1e308",
                                               "1e309",
                                               "1e-308",
                                               "1e-320",
                                               "5e-324",
                                               "1e-400",
                                               "0x10",
                                               "0xffffffffffffffff",
                                               "0b101",
                                               "0o17",
                                               "9223372036854775807",
                                               "-9223372036854775808",
                                               "9223372036854775808",
                                               "99999999999999999999999999",
                                               "1_000",
                                               "1__0",
                                               "01",
                                               "1.",
                                               ".5",
                                               "1e",
                                               "1e+",
                                               "--1",
                                               "1.2.3",
                                               "true",
                                               "false",
                                               "True",
                                               "null",
                                               "\"\"",
                                               "\"text\"",
                                               "'literal'",
                                               "\"\\u00e9\"",
                                               "\"\\ud800\"",
                                               "\"\\x\"",
                                               "\"a\\nb\"",
                                               "\"a\\tb\"",
                                               "\"\\u0000\"",
                                               "\"\"\"multi\nline\"\"\"",
                                               "'''a\nb'''",
                                               "\"open",
                                               "[]",
                                               "[1]",
                                               "[1, 2]",
                                               "[1, \"a\"]",
                                               "[[1]]",
                                               "[",
                                               "[1,,2]",
                                               "{}",
                                               "{a = 1}",
                                               "{a = {b = {c = 1}}}",
                                               "{",
                                               "1979-05-27",
                                               "1979-05-27T07:32:00Z",
                                               "07:32:00",
                                               "25:61:61",
                                               "1979-13-45",
                                               "",
                                               " ",
                                               "=",
                                               "# no value",
                                               "1 2",
                                               "1, 2",
                                               "16.5",
                                               "16.0",
                                               "1025",
                                               "1024",
                                               "2",
                                               "0.5000000001",
                                               "1e3000000000",
                                               "1e11 N/m",
                                               "１",
                                               "½",
                                               "∞"};
  return dice.pick(values);
}

/** Something that stands where a key or a table should. */
std::string odd_line(Dice& dice)
{
  static const std::vector<std::string> lines{"[",
                                              "]",
                                              "[]",
                                              "[[]]",
                                              "[[bearing]]",
                                              "[bearing.inner]",
                                              "[stator]",
                                              "[ rotor ]",
                                              "[a.b.c.d]",
                                              "[\"\"]",
                                              "[bearing",
                                              "= 1",
                                              "a.b = 1",
                                              "\"\" = 1",
                                              "\"mass_kg\" = 1",
                                              "mass_kg.x = 1",
                                              "stator = 1",
                                              "stator = {}",
                                              "key = key",
                                              "# comment",
                                              "\t",
                                              "\\",
                                              "\"",
                                              "'",
                                              "{}",
                                              "1",
                                              "title = \"again\"",
                                              "ball_radius_m = 0.01",
                                              "inner_race_radius_m = 0.07",
                                              "ball_radius_m = 1e300",
                                              "include \"x\"",
                                              "<xml/>",
                                              "é = 1",
                                              "key\u200b = 1",
                                              "\u2028"};
  return dice.pick(lines);
}

std::string random_bytes(Dice& dice, int count)
{
  std::string bytes;
  for (int k = 0; k < count; ++k) bytes += static_cast<char>(dice.roll(256));
  return bytes;
}

std::size_t place(Dice& dice, const std::string& content)
{
  return dice.roll(static_cast<int>(content.size()) + 1);
}

/** One thing wrong with the entries. */
void spoil_entries(Dice& dice, File& file)
{
  const auto at = dice.roll(static_cast<int>(file.size()));
  Entry& entry = file[at];
  switch (dice.roll(8)) {
    case 0:
      file.erase(file.begin() + at);
      return;
    case 1:
      file.insert(file.begin() + at, Entry(entry));
      return;
    case 2:
      entry.key += dice.pick<std::string>({"s", "_", " ", ".", "é", "\"", "=", "-"});
      return;
    case 3:
      entry.key.erase(dice.roll(static_cast<int>(entry.key.size())), 1);
      return;
    case 4:
      entry.table = dice.pick<std::string>({"", "stator", "rotor", "bearing", "x.y"});
      return;
    case 5:
      std::swap(entry.value, file[dice.roll(static_cast<int>(file.size()))].value);
      return;
    default:
      entry.value = odd_value(dice);
      return;
  }
}

/** One thing wrong with the text. */
void spoil_text(Dice& dice, std::string& content)
{
  const auto at = place(dice, content);
  switch (dice.roll(10)) {
    case 0:
      content.resize(at);
      return;
    case 1:
      content.insert(at, random_bytes(dice, 1 + dice.roll(8)));
      return;
    case 2:
      content = random_bytes(dice, dice.roll(400));
      return;
    case 3:
      content.insert(at, std::string(1 + dice.roll(20000), '['));
      return;
    case 4:
      content.insert(at, "x = " + std::string(1 + dice.roll(50000), '9') + "\n");
      return;
    case 5:
      content.insert(at, "\"" + std::string(1 + dice.roll(50000), 'k') + "\" = 1\n");
      return;
    case 6:
      for (std::size_t k = 0; (k = content.find('\n', k)) != std::string::npos; k += 2)
        content.insert(k, "\r");
      return;
    case 7:
      content.insert(0, dice.pick<std::string>({"\xef\xbb\xbf", "\xff\xfe", "\xc3"}));
      return;
    case 8:
      content.insert(at, std::string(1 + dice.roll(4), '\0'));
      return;
    default:
      content.insert(at, "\n" + odd_line(dice) + "\n");
      return;
  }
}

/** A number of a legal range: mostly of a likely size, sometimes of any that a double holds. */
std::string legal_size(Dice& dice, double low, double high)
{
  return dice.one_in(8) ? dice.decade_text(-320, 308) : dice.decade_text(low, high);
}

}  // namespace

std::string legal_file(Dice& dice, bool extreme)
{
  File file = good_file();
  if (!extreme) return written(file);
  for (const char* body : {"stator", "rotor"}) {
    if (dice.one_in(2)) value_of(file, body, "mass_kg") = legal_size(dice, -3, 4);
    if (dice.one_in(2))
      value_of(file, body, "natural_frequency_rad_per_s") = legal_size(dice, 0, 4);
    if (dice.one_in(3)) value_of(file, body, "damping_ratio") = legal_size(dice, -6, 1);
  }
  const auto maybe = [&](const char* table, const char* key, double low, double high) {
    if (dice.one_in(3))
      value_of(file, table, key) = legal_size(dice, low, high);
    else if (dice.one_in(6))
      value_of(file, table, key) = "0";
  };
  maybe("rotor", "unbalance_kg_m", -6, 1);
  maybe("bearing", "radial_clearance_m", -12, -1);
  maybe("gravity", "acceleration_m_per_s2", -3, 3);
  if (dice.one_in(2))
    value_of(file, "bearing", "contact_stiffness_N_per_m1p5") = legal_size(dice, 5, 16);
  if (dice.one_in(2))
    value_of(file, "bearing", "balls") =
        dice.pick<std::string>({"1", "2", "3", "4", "128", "1000", "1024"});
  if (dice.one_in(8)) value_of(file, "bearing", "cage_speed_ratio") = "0.4321";
  return written(file);
}

std::string spoilt_file(Dice& dice)
{
  File file = good_file();
  const int wrong = 1 + dice.roll(3);
  int in_text = 0;
  for (int k = 0; k < wrong; ++k) {
    if (dice.one_in(3))
      ++in_text;
    else
      spoil_entries(dice, file);
  }
  std::string content = written(file);
  for (int k = 0; k < in_text; ++k) spoil_text(dice, content);
  return content;
}

}  // namespace rotor_stator::tests
