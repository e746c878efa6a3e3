/**
# Files that a user names for input

Parameter files and scenes are TOML, read by a thin layer over toml++ that remembers which
keys were read. What is missing, of the wrong type, out of range or left over ends in
BadInput with file, line and key. */
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace rotor_stator {

/** Opens a file. Throws BadInput, naming what is `expected`, when it is missing,
    longer than `most_bytes`, or no regular file: devices and pipes may never end. */
std::ifstream open_file(const std::string& file, const std::string& expected,
                        std::uintmax_t most_bytes);

/** What a number must satisfy, beside being finite. */
enum class Range { any, positive, not_negative };

/** Several ways to give one value, each a list of keys. */
using Ways = std::vector<std::vector<std::string>>;

/** One table of a TOML file. Copies share the record of the keys that were read. */
class StrictToml {
public:
  /** Parses a file. Throws BadInput when it is missing, not a file, too long, empty,
      nested too deeply or not TOML. */
  explicit StrictToml(const std::string& file);

  /** The same for `content` at hand, called `file` in messages. */
  StrictToml(const std::string& file, const std::string& content);

  /** The same tables, nothing of them read yet, with a number set or added at each dotted
      key; `bearing.2.balls` is in the second of [[bearing]], `stator.load_N.2` in an
      array. What a key `excludes` is dropped; throws BadInput for two values that exclude
      each other, in whatever units. */
  using Excludes = bool (*)(const std::string& key, const std::string& other);
  StrictToml with(const std::vector<std::pair<std::string, double>>& values,
                  Excludes excludes = nullptr) const;

  const std::string& file() const;
  bool has(const std::string& key) const;

  /** Whether the key is there as [[key]]. */
  bool has_tables(const std::string& key) const;

  /** Which of the ways is taken: the one of which any key is there. Throws BadInput where
      there are keys of two, or of none. */
  std::size_t way(const Ways& ways) const;

  double number(const std::string& key, Range range);
  double number_or(const std::string& key, Range range, double otherwise)
  {
    return has(key) ? number(key, range) : otherwise;
  }
  int integer(const std::string& key, int least, int most);
  int integer_or(const std::string& key, int least, int most, int otherwise)
  {
    return has(key) ? integer(key, least, most) : otherwise;
  }
  std::string string(const std::string& key);

  /** Those of an array of this `shape`; as many as it names where it is as "[x, y]". */
  std::vector<double> numbers(const std::string& key, Range range,
                              const std::string& shape = "a non-empty array");
  std::vector<int> integers(const std::string& key, int least, int most,
                            const std::string& shape = "a non-empty array");
  std::vector<std::string> strings(const std::string& key);
  bool flag(const std::string& key);
  StrictToml table(const std::string& key);
  std::vector<StrictToml> tables(const std::string& key);

  /** The keys of this table, in the file's alphabet. */
  std::vector<std::string> keys() const;

  /** All keys but one with their values: comments and order leave no trace. */
  std::string text_without(const std::string& key) const;

  /** Throws BadInput about `key`: file, line, key and `problem`. */
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

  /** All keys that may stand here, in one call or several: beside a missing one any other
      is named. */
  void may_hold(const Ways& keys) const;

  /** Throws BadInput about a required key: names the key that it, or one of other `ways`
      to give the value, may have been misspelt as, if any. */
  [[noreturn]] void missing(const std::string& key, const std::string& advice = "",
                            const Ways& ways = {}) const;

  /** Throws BadInput if a key, also of a table in it that was read, was never read. */
  void refuse_unknown_keys() const;

private:
  struct Content;
  StrictToml(std::shared_ptr<Content> content) : content_(std::move(content)) {}
  std::shared_ptr<Content> content_;
};

/**
## Scenes

A scene is what one figure asks to be modelled: which data sets, which speeds, how many
harmonics and samples, how the time integration is set. It is a file in data/scenes/. */

/** A scene file being read, with the reading of Table 1 (D-09): "exchanged" or
    "as-printed". */
class SceneFile {
public:
  SceneFile(const std::string& file, const std::string& reading);

  StrictToml& toml() { return toml_; }
  const std::string& reading() const { return reading_; }

  /** The file of the data set named by a key: "set1" is data/set1.toml beside the scenes'
      folder, or data/set1-as-printed.toml under that reading. */
  std::string data_set(const std::string& key) { return file_of(toml_.string(key)); }
  std::vector<std::string> data_sets(const std::string& key);

  /** `from`, `to` and `step` in hertz, both ends included. */
  std::vector<double> speed_range(const std::string& key);

private:
  std::string file_of(const std::string& name) const;

  std::string reading_;
  StrictToml toml_;
};

}  // namespace rotor_stator
