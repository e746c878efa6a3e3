#include "io/strict_toml.hpp"

#include <toml++/toml.h>
#include <cmath>
#include <set>
#include <sstream>

#include "io/errors.hpp"
#include "io/files.hpp"

namespace rotor_stator
{

struct StrictToml::Content {
  std::string file;
  std::string path;  ///< dotted prefix of this table, "" at the root
  toml::table table;
  std::set<std::string> read;
  std::vector<std::pair<std::string, std::shared_ptr<Content>>> inner_tables;

  /** The node of a required key. */
  toml::node& require(const std::string& key, const StrictToml& reader)
  {
    read.insert(key);
    if (toml::node* node = table.get(key)) return *node;
    reader.missing(key);
  }

  /** The table in a node of this one. */
  StrictToml inner(toml::node& node, const std::string& key)
  {
    auto content = std::make_shared<Content>();
    inner_tables.emplace_back(key, content);
    content->file = file;
    content->path = path + key + ".";
    content->table = std::move(*node.as_table());
    return StrictToml(content);
  }

  static std::string line(const toml::node& node)
  {
    return ":" + std::to_string(node.source().begin.line);
  }
};

namespace
{

/** No parameter or scene file comes near these. */
constexpr std::uintmax_t most_bytes = 1'000'000;
constexpr int most_levels = 16;

/** Throws BadInput where arrays, tables or the parts of a key stand deeper in one another: toml++ takes
    one more call for each level. */
void refuse_deep_nesting(const std::string& file, const std::string& content)
{
  int open = 0, parts = 0, line = 1;
  for (std::size_t k = 0; k < content.size(); ++k) {
    const char c = content[k];
    if (c == '#') k = std::min(content.find('\n', k), content.size()) - 1;
    if (c == '"' || c == '\'') {
      const bool many = content.compare(k, 3, std::string(3, c)) == 0;
      const std::string end(many ? 3 : 1, c);
      const auto goes_on = [&] {
        return k < content.size() && content.compare(k, end.size(), end) != 0 &&
               (many || content[k] != '\n');
      };
      for (k += end.size(); goes_on(); k += c == '"' && content[k] == '\\' ? 2 : 1)
        line += content[k] == '\n';
      k += end.size();
      while (many && k < content.size() && content[k] == c) ++k;
      --k;
    }
    open += (c == '[' || c == '{') - (c == ']' || c == '}');
    parts = c == '.' ? parts + 1 : std::string_view("=,[]{}\n").find(c) < 7 ? 0 : parts;
    if (open > most_levels || parts > most_levels)
      throw BadInput(format("%s:%d: more than %d levels of keys, tables or arrays",
                            file.c_str(), line, most_levels));
    line += c == '\n';
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
  refuse_deep_nesting(file, content.str());
  return content.str();
}

/** The first line of a parser's message. */
std::string first_line(std::string_view message)
{
  return std::string(message.substr(0, message.find('\n')));
}

/** The number in a node, or why there is none. */
double checked_number(const toml::node& node, Range range, const StrictToml& reader,
                      const std::string& key)
{
  if (!node.is_number()) reader.fail(key, "must be a number");
  const double value = *node.value<double>();
  if (!std::isfinite(value)) reader.fail(key, "must be finite");
  if (range == Range::positive && value <= 0)
    reader.fail(key, format("must be > 0, got %g", value));
  if (range == Range::not_negative && value < 0)
    reader.fail(key, format("must be >= 0, got %g", value));
  return value;
}

int checked_integer(const toml::node& node, int least, int most, const StrictToml& reader,
                    const std::string& key)
{
  if (!node.is_integer()) reader.fail(key, "must be a whole number");
  const auto value = *node.value<std::int64_t>();
  if (value < least || value > most)
    reader.fail(key, format("must be in %d...%d, got %lld", least, most,
                            static_cast<long long>(value)));
  return static_cast<int>(value);
}

std::string checked_string(const toml::node& node, const StrictToml& reader,
                           const std::string& key)
{
  if (!node.is_string()) reader.fail(key, "must be a string");
  const auto value = *node.value<std::string>();
  if (printable(value) != value)
    reader.fail(key, "must be one line without control characters");
  return value;
}

/** Applies `check` to each element of a non-empty array. */
template <class T, class Check>
std::vector<T> checked_array(const toml::node& node, const StrictToml& reader,
                             const std::string& key, Check check)
{
  if (!node.is_array() || node.as_array()->empty())
    reader.fail(key, "must be a non-empty array");
  std::vector<T> values;
  for (const toml::node& element : *node.as_array()) values.push_back(check(element));
  return values;
}

}  // namespace

StrictToml::StrictToml(const std::string& file) : content_(std::make_shared<Content>())
{
  content_->file = file;
  try {
    content_->table = toml::parse(content_of(file), file);
  } catch (const toml::parse_error& error) {
    throw BadInput(file + ":" + std::to_string(error.source().begin.line) +
                   ": not TOML: " + first_line(error.description()));
  }
}

bool StrictToml::has(const std::string& key) const
{
  return content_->table.contains(key);
}

double StrictToml::number(const std::string& key, Range range)
{
  return checked_number(content_->require(key, *this), range, *this, key);
}

double StrictToml::number_or(const std::string& key, Range range, double otherwise)
{
  return has(key) ? number(key, range) : otherwise;
}

int StrictToml::integer(const std::string& key, int least, int most)
{
  return checked_integer(content_->require(key, *this), least, most, *this, key);
}

int StrictToml::integer_or(const std::string& key, int least, int most, int otherwise)
{
  return has(key) ? integer(key, least, most) : otherwise;
}

std::string StrictToml::string(const std::string& key)
{
  return checked_string(content_->require(key, *this), *this, key);
}

std::vector<double> StrictToml::numbers(const std::string& key, Range range)
{
  return checked_array<double>(
      content_->require(key, *this), *this, key,
      [&](const toml::node& node) { return checked_number(node, range, *this, key); });
}

std::vector<int> StrictToml::integers(const std::string& key, int least, int most)
{
  return checked_array<int>(content_->require(key, *this), *this, key,
                            [&](const toml::node& node) {
                              return checked_integer(node, least, most, *this, key);
                            });
}

std::vector<std::string> StrictToml::strings(const std::string& key)
{
  return checked_array<std::string>(
      content_->require(key, *this), *this, key,
      [&](const toml::node& node) { return checked_string(node, *this, key); });
}

bool StrictToml::flag(const std::string& key)
{
  const toml::node& node = content_->require(key, *this);
  if (!node.is_boolean()) fail(key, "must be true or false");
  return *node.value<bool>();
}

StrictToml StrictToml::table(const std::string& key)
{
  toml::node& node = content_->require(key, *this);
  if (!node.is_table()) fail(key, "must be a table");
  for (const auto& [name, known] : content_->inner_tables)
    if (name == key) return StrictToml(known);
  return content_->inner(node, key);
}

std::vector<StrictToml> StrictToml::tables(const std::string& key)
{
  toml::node& node = content_->require(key, *this);
  if (!node.is_array_of_tables()) fail(key, "must be [[" + key + "]] tables");
  std::vector<StrictToml> list;
  for (toml::node& element : *node.as_array())
    list.push_back(content_->inner(element, key));
  return list;
}

std::vector<std::string> StrictToml::keys() const
{
  std::vector<std::string> list;
  for (const auto& [key, node] : content_->table) list.emplace_back(key.str());
  return list;
}

void StrictToml::fail(const std::string& key, const std::string& problem) const
{
  const toml::node* node = content_->table.get(key);
  const toml::node& place = node ? *node : content_->table;
  throw BadInput(content_->file + Content::line(place) + ": " + content_->path + key +
                 " " + problem);
}

void StrictToml::missing(const std::string& key, const std::string& advice) const
{
  for (const std::string& found : keys()) {
    const std::string meant = suggestion(found, {key});
    if (!content_->read.contains(found) && !meant.empty())
      fail(found, "is not a known key here" + meant + " (" + content_->path + key +
                      " is missing" + advice + ")");
  }
  fail(key, "is missing" + advice);
}

void StrictToml::refuse_unknown_keys() const
{
  const std::vector<std::string> known(content_->read.begin(), content_->read.end());
  for (const std::string& key : keys()) {
    if (content_->read.contains(key)) continue;
    std::string list;
    for (const std::string& other : known) list += (list.empty() ? "" : ", ") + other;
    fail(key,
         "is not a known key here" + suggestion(key, known) + " (known: " + list + ")");
  }
  for (const auto& [name, inner] : content_->inner_tables)
    StrictToml(inner).refuse_unknown_keys();
}

}  // namespace rotor_stator
