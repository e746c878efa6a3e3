#include "hard/fuzz_file.hpp"

#include <utility>

#include "hard/fuzz_words.hpp"

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

/** One thing wrong with the key of an entry, or with its place. */
void spoil_key(Dice& dice, File& file, int at)
{
  Entry& entry = file[at];
  const int size = static_cast<int>(entry.key.size());
  const int which = dice.roll(5);
  if (which == 0) file.erase(file.begin() + at);
  if (which == 1) file.insert(file.begin() + at, Entry(entry));
  if (which == 2)
    entry.key += dice.pick<std::string>({"s", "_", " ", ".", "é", "\"", "=", "-"});
  if (which == 3) entry.key.erase(dice.roll(size), 1);
  if (which == 4)
    entry.table = dice.pick<std::string>({"", "stator", "rotor", "bearing", "x.y"});
}

/** One thing wrong with the entries. */
void spoil_entries(Dice& dice, File& file)
{
  const int at = dice.roll(static_cast<int>(file.size()));
  if (!dice.one_in(3)) return spoil_key(dice, file, at);
  if (dice.one_in(4))
    std::swap(file[at].value, file[dice.roll(static_cast<int>(file.size()))].value);
  else
    file[at].value = dice.pick(odd_values());
}

std::string times(int count, char c)
{
  return std::string(count, c);
}

/** Something that is inserted anywhere. */
std::string foreign_text(Dice& dice)
{
  switch (dice.roll(6)) {
    case 0:
      return random_bytes(dice, 1 + dice.roll(8));
    case 1:
      return times(1 + dice.roll(20000), '[');
    case 2:
      return "x = " + times(1 + dice.roll(50000), '9') + "\n";
    case 3:
      return "\"" + times(1 + dice.roll(50000), 'k') + "\" = 1\n";
    case 4:
      return times(1 + dice.roll(4), '\0');
    default:
      return "\n" + dice.pick(odd_lines()) + "\n";
  }
}

/** One thing wrong with the text: cut, replaced, other ends of lines, another encoding, or something
    foreign in it. */
void spoil_text(Dice& dice, std::string& content)
{
  const auto at = place(dice, content);
  const int which = dice.roll(10);
  if (which == 0) content.resize(at);
  if (which == 1) content = random_bytes(dice, dice.roll(400));
  if (which == 2)
    for (std::size_t k = 0; (k = content.find('\n', k)) != std::string::npos; k += 2)
      content.insert(k, "\r");
  if (which == 3)
    content.insert(0, dice.pick<std::string>({"\xef\xbb\xbf", "\xff\xfe", "\xc3"}));
  if (which > 3) content.insert(at, foreign_text(dice));
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
  const auto maybe = [&](const char* table, const char* key, double low, double high) {
    if (dice.one_in(2)) value_of(file, table, key) = legal_size(dice, low, high);
  };
  for (const char* body : {"stator", "rotor"}) {
    maybe(body, "mass_kg", -3, 4);
    maybe(body, "natural_frequency_rad_per_s", 0, 4);
    maybe(body, "damping_ratio", -6, 1);
  }
  maybe("bearing", "contact_stiffness_N_per_m1p5", 5, 16);
  const auto or_zero = [&](const char* table, const char* key, double low, double high) {
    maybe(table, key, low, high);
    if (dice.one_in(6)) value_of(file, table, key) = "0";
  };
  or_zero("rotor", "unbalance_kg_m", -6, 1);
  or_zero("bearing", "radial_clearance_m", -12, -1);
  or_zero("gravity", "acceleration_m_per_s2", -3, 3);
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
