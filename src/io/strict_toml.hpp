/**
# TOML without surprises

A thin layer over toml++ that remembers which keys were read. What is missing, of the
wrong type, out of range or left over ends in BadInput with file, line and key. */
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace rotor_stator
{

/** What a number must satisfy, beside being finite. */
enum class Range { any, positive, not_negative };

/** One table of a TOML file. Copies share the record of the keys that were read. */
class StrictToml
{
public:
  /** Parses a file. Throws BadInput when it is missing, not a file, too long, empty, nested too
      deeply or not TOML. */
  explicit StrictToml(const std::string& file);

  bool has(const std::string& key) const;
  double number(const std::string& key, Range range);
  double number_or(const std::string& key, Range range, double otherwise);
  int integer(const std::string& key, int least, int most);
  int integer_or(const std::string& key, int least, int most, int otherwise);
  std::string string(const std::string& key);
  std::vector<double> numbers(const std::string& key, Range range);
  std::vector<int> integers(const std::string& key, int least, int most);
  std::vector<std::string> strings(const std::string& key);
  bool flag(const std::string& key);
  StrictToml table(const std::string& key);
  std::vector<StrictToml> tables(const std::string& key);

  /** The keys of this table, in the file's alphabet. */
  std::vector<std::string> keys() const;

  /** Throws BadInput about `key`: file, line, key and `problem`. */
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

  /** Throws BadInput about a required key: names the key that it may have been misspelt as, if any. */
  [[noreturn]] void missing(const std::string& key, const std::string& advice = "") const;

  /** Throws BadInput if a key of this table, or of a table in it that was asked for, was never asked
      for. */
  void refuse_unknown_keys() const;

private:
  struct Content;
  StrictToml(std::shared_ptr<Content> content) : content_(std::move(content)) {}
  std::shared_ptr<Content> content_;
};

}  // namespace rotor_stator
