#include "io/toml_file.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "io/errors.hpp"
#include "io/units.hpp"

namespace rotor_stator {

std::ifstream open_file(const std::string& file, const std::string& expected,
                        std::uintmax_t most_bytes)
{
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw BadInput("'" + file + "': " +
                   (status.type() == std::filesystem::file_type::not_found
                        ? "no such file"
                        : error.message()));
  if (!std::filesystem::is_regular_file(status))
    throw BadInput(file + ": is " +
                   (is_directory(status) ? "a directory" : "no regular file") + "; " +
                   expected + " is expected");
  if (std::filesystem::file_size(file, error) > most_bytes)
    throw BadInput(format("%s: is longer than %ju bytes; %s is expected", file.c_str(),
                          most_bytes, expected.c_str()));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw BadInput(file + ": cannot be read");
  return in;
}

namespace {

/** No parameter or scene file comes near it. */
constexpr std::uintmax_t most_bytes = 1'000'000;

/** The bound of toml++ on nested values. It has none on the parts of a key, but takes a
    call for each. */
constexpr int most_levels = 256;

[[noreturn]] void refuse_levels(const std::string& file, int line)
{
  throw BadInput(format("%s:%d: more than %d levels of keys, tables or arrays",
                        file.c_str(), line, most_levels));
}

/** Counts the dots before each = and ]; two in a row stand in no key. */
void refuse_long_keys(const std::string& file, const std::string& content)
{
  int parts = 0, line = 1;
  char before = 0;
  for (const char c : content) {
    if ((c == '=' || c == ']') && parts > most_levels) refuse_levels(file, line);
    if (c == '.') parts = before == '.' ? 0 : parts + 1;
    if (std::string_view("=,[]{}\n").find(c) < 7) parts = 0;
    line += c == '\n';
    before = c;
  }
}

/** A whole file as text. */
std::string content_of(const std::string& file)
{
  std::ifstream in = open_file(file, "a TOML file", most_bytes);
  std::ostringstream content;
  content << in.rdbuf();
  if (content.str().find_first_not_of(" \t\r\n") == std::string::npos)
    throw BadInput(file + ": is empty; a TOML file is expected");
  refuse_long_keys(file, content.str());
  return content.str();
}

/** Why a node is not what was asked for. */
struct Refused {
  std::string why;
};

double as_number(const toml::node& node, const std::string& key, Range range)
{
  if (const auto word = node.value<std::string>()) {
    /** Also of G6.3, a balance grade. */
    const std::size_t at = word->starts_with('G') ? 1 : 0;
    if (const auto value = decimal(word->substr(at)))
      throw Refused{format("must be a number, without letters and quotes: %.9g", *value)};
  }
  if (!node.is_number()) throw Refused{"must be a number"};
  const double given = *node.value<double>(), value = in_own_unit(key, given);
  if (!std::isfinite(value)) throw Refused{"must be finite"};
  if (range == Range::positive && value <= 0)
    throw Refused{format("must be > 0, got %g", given)};
  if (range == Range::not_negative && value < 0)
    throw Refused{format("must be >= 0, got %g", given)};
  return value;
}

int as_integer(const toml::node& node, int least, int most)
{
  if (!node.is_integer()) throw Refused{"must be a whole number"};
  const auto value = *node.value<std::int64_t>();
  if (value < least || value > most)
    throw Refused{format("must be in %d...%d, got %lld", least, most,
                         static_cast<long long>(value))};
  return static_cast<int>(value);
}

std::string as_string(const toml::node& node)
{
  if (!node.is_string()) throw Refused{"must be a string, in quotes"};
  const auto value = *node.value<std::string>();
  if (printable(value) != value)
    throw Refused{"must be one line without control characters"};
  return value;
}

}  // namespace

struct StrictToml::Content {
  std::string file;
  std::string path;  ///< dotted prefix of this table, "" at the root
  toml::table table;
  std::set<std::string> read = {}, asked = {};  ///< keys; those that may stand here
  std::vector<std::pair<std::string, std::shared_ptr<Content>>> inner_tables = {};
  std::set<std::string> expected = {};  ///< by may_hold

  /** A key as it stands in the file, perhaps in another unit. */
  std::string written(const std::string& key) const
  {
    std::string found = key;
    for (const auto& [name, node] : table) {
      const std::string other(name.str());
      if (other == key || own_key(other) != key) continue;
      if (found != key || table.contains(key))
        throw BadInput(format("%s:%d: %s and %s are both given; give one of them",
                              file.c_str(), static_cast<int>(node.source().begin.line),
                              (path + other).c_str(),
                              (found == key ? key : found).c_str()));
      found = other;
    }
    return found;
  }

  /** What `take` makes of the node of a required key. */
  template <class Take>
  auto one(const StrictToml& reader, const std::string& key, Take take)
  {
    const std::string name = written(key);
    read.insert(name);
    asked.insert(key);
    toml::node* node = table.get(name);
    if (!node) reader.missing(key);
    try {
      return take(*node);
    } catch (const Refused& refused) {
      reader.fail(key, refused.why);
    }
  }

  /** What `take` makes of each element of an array, which has as many as its shape. */
  template <class Take>
  auto all(const StrictToml& reader, const std::string& key, Take take,
           const std::string& shape = "a non-empty array")
  {
    const auto commas = std::count(shape.begin(), std::ranges::find(shape, ']'), ',');
    return one(reader, key, [&](toml::node& node) {
      const std::size_t size = node.is_array() ? node.as_array()->size() : 0;
      if (!node.is_array() || (commas > 0 && size != commas + 1ul) ||
          (size == 0 && shape != "an array"))
        throw Refused{"must be " + shape};
      std::vector<decltype(take(node))> values;
      for (toml::node& element : *node.as_array()) values.push_back(take(element));
      return values;
    });
  }

  /** The table in a node of this one. */
  StrictToml inner(toml::node& node, const std::string& key)
  {
    const auto own = std::make_shared<Content>(
        Content{file, path + key + ".", std::move(*node.as_table())});
    inner_tables.emplace_back(key, own);
    return StrictToml(own);
  }
};

StrictToml::StrictToml(const std::string& file) : StrictToml(file, content_of(file)) {}

StrictToml::StrictToml(const std::string& file, const std::string& content)
    : content_(std::make_shared<Content>())
{
  content_->file = file;
  try {
    content_->table = toml::parse(content, file);
  } catch (const toml::parse_error& error) {
    const std::string message(error.description());
    const auto line = static_cast<int>(error.source().begin.line);
    const auto says = [&](const char* words) {
      return message.find(words) != message.npos;
    };
    if (says("TOML_MAX_NESTED_VALUES")) refuse_levels(file, line);
    throw BadInput(format("%s:%d: not TOML: ", file.c_str(), line) +
                   message.substr(0, message.find('\n')) +
                   (says("could not determine value type") ? "; words stand in quotes"
                    : says("saw ','")                      ? "; decimals have a point"
                                                           : ""));
  }
  for (const auto& [key, node] : content_->table)
    if (key.str() == "ross_version" || key.str().starts_with("ShaftElement"))
      throw BadInput(file +
                     ": is a rotor of ROSS; peers/from_ross.py writes its "
                     "matrices, which a machine's file then names");
}

/**
## A file with other values */

namespace {

/** Sets what a dotted key names: a table is new where there is none, the elements of an
    array count from 1. Whole numbers become integers, which are read as numbers too. */
void set_number(toml::node& at, const std::string& key, double value,
                StrictToml::Excludes excludes)
{
  const auto dot = key.find('.');
  const std::string word = key.substr(0, dot);
  toml::table* const table = at.as_table();
  toml::array* const array = at.as_array();
  const double k = array ? decimal(word).value_or(0) : 0;
  if (!table && !(array && k >= 1 && k <= static_cast<double>(array->size())))
    throw BadInput(word + ": names nothing in the parameter file" +
                   (array ? format("; its %zu entries are counted from 1, as in "
                                   "bearing.2.balls",
                                   array->size())
                          : ""));
  const auto place = static_cast<std::size_t>(k) - 1;
  if (dot != key.npos)
    return set_number(
        table ? table->insert(word, toml::table{}).first->second : (*array)[place],
        key.substr(dot + 1), value, excludes);
  const std::string own = own_key(key);
  value = in_own_unit(key, value);
  if (table) {
    std::set<std::string> replaced;
    for (const auto& [name, node] : *table) {
      const std::string other = own_key(std::string(name.str()));
      if (other == own || (excludes && excludes(own, other)))
        replaced.insert(std::string(name.str()));
    }
    for (const std::string& name : replaced) table->erase(name);
  }
  const auto set = [&](auto number) {
    if (table)
      table->insert_or_assign(own, number);
    else
      array->replace(array->cbegin() + static_cast<long>(place), number);
  };
  if (value == std::round(value) && std::abs(value) < 1e15)
    set(static_cast<std::int64_t>(value));
  else
    set(value);
}

}  // namespace

StrictToml StrictToml::with(const std::vector<std::pair<std::string, double>>& values,
                            Excludes excludes) const
{
  StrictToml changed(std::make_shared<Content>(
      Content{content_->file, content_->path, content_->table}));
  const auto parts = [](const std::string& key) {
    const auto last = key.rfind('.') + 1;
    return std::pair{key.substr(0, last), own_key(key.substr(last))};
  };
  for (auto at = values.begin(); at != values.end(); ++at) {
    const std::string& key = at->first;
    if (std::ranges::count(key, '.') > most_levels)
      throw BadInput(format("%.40s...: more than %d levels", key.c_str(), most_levels));
    const auto [table, own] = parts(key);
    for (auto before = values.begin(); before != at; ++before)
      if (const auto [other_table, other] = parts(before->first);
          table == other_table && (own == other || (excludes && excludes(own, other))))
        throw BadInput(before->first + " and " + key +
                       ": a table takes one of them, not both");
    set_number(changed.content_->table, key, at->second, excludes);
  }
  return changed;
}

const std::string& StrictToml::file() const
{
  return content_->file;
}

bool StrictToml::has(const std::string& key) const
{
  content_->asked.insert(key);
  return content_->table.contains(content_->written(key));
}

bool StrictToml::has_tables(const std::string& key) const
{
  return content_->table[key].is_array();
}

std::size_t StrictToml::way(const Ways& ways) const
{
  std::string given, advice;
  std::size_t taken = ways.size();
  for (std::size_t k = 0; k < ways.size(); ++k) {
    std::string keys;
    for (const std::string& key : ways[k]) {
      keys += (keys.empty() ? "" : key == ways[k].back() ? " and " : ", ") + key;
      if (!has(key) || taken == k) continue;
      if (taken < k) fail(key, "and " + given + " are both given; give one of them");
      taken = k;
      given = content_->written(key);
    }
    if (k > 0) advice += (k == 1 ? "; give it, or " : ", or ") + keys;
  }
  if (taken == ways.size()) missing(ways[0][0], advice, ways);
  for (const std::string& key : ways[taken])
    content_->read.insert(content_->written(key));
  return taken;
}

double StrictToml::number(const std::string& key, Range range)
{
  const std::string name = content_->written(key);
  return content_->one(*this, key,
                       [&](auto& node) { return as_number(node, name, range); });
}

int StrictToml::integer(const std::string& key, int least, int most)
{
  return content_->one(*this, key,
                       [&](auto& node) { return as_integer(node, least, most); });
}

std::string StrictToml::string(const std::string& key)
{
  return content_->one(*this, key, as_string);
}

std::vector<double> StrictToml::numbers(const std::string& key, Range range,
                                        const std::string& shape)
{
  const std::string name = content_->written(key);
  return content_->all(
      *this, key, [&](auto& node) { return as_number(node, name, range); }, shape);
}

std::vector<int> StrictToml::integers(const std::string& key, int least, int most,
                                      const std::string& shape)
{
  return content_->all(
      *this, key, [&](auto& node) { return as_integer(node, least, most); }, shape);
}

std::vector<std::string> StrictToml::strings(const std::string& key)
{
  return content_->all(*this, key, as_string);
}

bool StrictToml::flag(const std::string& key)
{
  return content_->one(*this, key, [](auto& node) {
    if (!node.is_boolean()) throw Refused{"must be true or false"};
    return *node.template value<bool>();
  });
}

StrictToml StrictToml::table(const std::string& key)
{
  for (const auto& [name, known] : content_->inner_tables)
    if (name == key) return StrictToml(known);
  return content_->one(*this, key, [&](auto& node) {
    if (!node.is_table())
      throw Refused{"must be a table, [" + content_->path + key + "]"};
    return content_->inner(node, key);
  });
}

std::vector<StrictToml> StrictToml::tables(const std::string& key)
{
  return content_->all(*this, key, [&](auto& node) {
    if (!node.is_table()) throw Refused{"must be [[" + key + "]] tables"};
    return content_->inner(node, key);
  });
}

std::vector<std::string> StrictToml::keys() const
{
  std::vector<std::string> list;
  for (const auto& [key, node] : content_->table) list.emplace_back(key.str());
  return list;
}

std::string StrictToml::text_without(const std::string& key) const
{
  toml::table table = content_->table;
  table.erase(key);
  return (std::ostringstream() << table).str();
}

void StrictToml::fail(const std::string& key, const std::string& problem) const
{
  const std::string name = content_->written(key);
  const toml::node* node = content_->table.get(name);
  const toml::node& place = node ? *node : content_->table;
  const auto line = static_cast<int>(place.source().begin.line);
  throw BadInput(content_->file + (line > 0 ? format(":%d: ", line) : ": ") +
                 content_->path + name + " " + problem);
}

void StrictToml::may_hold(const Ways& keys) const
{
  for (const auto& way : keys) content_->expected.insert(way.begin(), way.end());
}

void StrictToml::missing(const std::string& key, const std::string& advice,
                         const Ways& ways) const
{
  std::vector<std::string> wanted{key};
  for (const auto& way : ways) wanted.insert(wanted.end(), way.begin(), way.end());
  const std::set<std::string>&all = content_->expected, &asked = content_->asked;
  for (const std::string& found : keys()) {
    const std::string own = own_key(found), instead = meant(found, wanted);
    if (content_->read.contains(found) || all.contains(own) || asked.contains(own) ||
        (all.empty() && instead.empty()))
      continue;
    fail(found, "is not a known key here" + instead + " (" + content_->path + key +
                    " is missing" + advice + ")");
  }
  fail(key, "is missing" + advice);
}

void StrictToml::refuse_unknown_keys() const
{
  const std::vector<std::string> known(content_->asked.begin(), content_->asked.end());
  for (const std::string& key : keys()) {
    if (content_->read.contains(key)) continue;
    fail(key, "is not a known key here" + meant(key, known) +
                  " (known: " + joined(known, ", ") + ")");
  }
  for (const auto& [name, inner] : content_->inner_tables)
    StrictToml(inner).refuse_unknown_keys();
}

/**
## Scenes */

SceneFile::SceneFile(const std::string& file, const std::string& reading)
    : reading_(reading), toml_(file)
{
  if (reading != "exchanged" && reading != "as-printed")
    throw BadInput("--reading " + reading + ": must be exchanged or as-printed");
}

std::string SceneFile::file_of(const std::string& name) const
{
  const std::string suffix = reading_ == "exchanged" ? "" : "-" + reading_;
  const auto data = std::filesystem::path(toml_.file()).parent_path().parent_path();
  return (data / (name + suffix + ".toml")).string();
}

std::vector<std::string> SceneFile::data_sets(const std::string& key)
{
  std::vector<std::string> files = toml_.strings(key);
  for (std::string& name : files) name = file_of(name);
  return files;
}

std::vector<double> SceneFile::speed_range(const std::string& key)
{
  StrictToml table = toml_.table(key);
  const double from = table.number("from", Range::positive);
  const double to = table.number("to", Range::positive);
  const double step = table.number("step", Range::positive);
  table.refuse_unknown_keys();
  if (to <= from) table.fail("to", "must be above from");
  if ((to - from) / step > 1e5) table.fail("step", "gives more than 100000 speeds");
  const double count = std::round((to - from) / step);
  if (std::abs(from + count * step - to) > 1e-9 * to)
    table.fail("step", "must divide the range");
  std::vector<double> speeds;
  for (double k = 0; k <= count; ++k) speeds.push_back(from + (to - from) * k / count);
  return speeds;
}

}  // namespace rotor_stator
