/**
# The two ways a program can end badly

Exit status 2 is the reader's to mend (a parameter file, an option); 3 says that the
question was well put and no answer was found. Each carries one line for stderr. */
#pragma once

#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rotor_stator {

/** Bad input: the message names file, line and key, or option, and what is accepted. */
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** No solution to the tolerance asked: the message says where and why. */
struct NoSolution : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** Integration left all numbers: its steps may be too long. */
struct Diverged : NoSolution {
  using NoSolution::NoSolution;
};

/** A value, or why there is none. */
template <class Value>
class Attempt {
public:
  Attempt() = default;
  Attempt(Value value) : value_(std::move(value)) {}
  Attempt(std::exception_ptr why) : why_(std::move(why)) {}

  /** Throws what there is instead of a value. */
  Value& get()
  {
    if (!value_) std::rethrow_exception(why_);
    return *value_;
  }
  bool has_value() const { return value_.has_value(); }

private:
  std::optional<Value> value_;
  std::exception_ptr why_;
};

/** What `make` gives, or the NoSolution that it throws. */
template <class Make>
auto attempt(const Make& make) -> Attempt<decltype(make())>
{
  try {
    return make();
  } catch (const NoSolution&) {
    return std::current_exception();
  }
}

/** A value that is computed when it is first asked for, or why there is none. */
template <class Value>
class Once {
public:
  template <class Make>
  const Value& operator()(const Make& make)
  {
    if (!made_) made_ = attempt([&]() -> Value { return make(); });
    return made_->get();
  }

private:
  std::optional<Attempt<Value>> made_;
};

/**
## Messages: numbers and lists as words */

/** printf-style formatting of one message. */
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

/** The text on one line: control characters and Unicode's ends of lines as \xNN. */
std::string printable(const std::string& text);

/** The words in a row, `between` each two of them. */
std::string joined(const std::vector<std::string>& words, const std::string& between);

/** "; did you mean …?" with the known word that is nearest to `word`, if one is near. */
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

/** The finite number that a whole word is in decimal notation, if it is one. */
std::optional<double> decimal(const std::string& word);

/** Where its digits or its minus sign begin: a plus sign, which from_chars does not know,
    is skipped. */
const char* after_plus(const std::string& word);

}  // namespace rotor_stator
