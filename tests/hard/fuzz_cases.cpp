#include "hard/fuzz_cases.hpp"

#include "hard/fuzz_file.hpp"
#include "hard/fuzz_words.hpp"

namespace rotor_stator::tests
{

namespace
{

/** One of the odd words, or a very long one. */
std::string odd_word(Dice& dice)
{
  if (dice.one_in(20))
    return std::string(1 + dice.roll(5000), dice.one_in(2) ? '9' : 'x');
  return dice.pick(odd_words());
}

struct Option {
  std::string name;
  std::string value;
};

std::string whole(Dice& dice, double low, double high)
{
  return format("%.0f", dice.decade(low, high));
}

std::string some_method(Dice& dice)
{
  return dice.pick<std::string>({"aft", "aft", "aft", "rk4", "rk4", "rkf45", "rkck",
                                 "rk8pd", "msadams", "msbdf", "bsimp"});
}

/** Legal options of orbit and contact; `extreme` takes their whole range. */
std::vector<Option> motion_options(Dice& dice, bool extreme)
{
  std::vector<Option> options{
      {"--frequency", extreme ? dice.decade_text(-3, 5) : dice.decade_text(0, 2)}};
  if (extreme && dice.one_in(10)) options[0].value = dice.decade_text(-300, 300);
  if (dice.one_in(2)) options.push_back({"--method", some_method(dice)});
  if (dice.one_in(2))
    options.push_back({"--harmonics", whole(dice, 0, extreme ? 3.6 : 1.5)});
  if (dice.one_in(4)) options.push_back({"--samples", whole(dice, 1, extreme ? 6 : 3)});
  if (dice.one_in(2)) options.push_back({"--points", whole(dice, 0, extreme ? 3.5 : 2)});
  if (dice.one_in(4)) options.push_back({"--tolerance", dice.decade_text(-8, -1)});
  if (dice.one_in(4))
    options.push_back({"--newton-tolerance", dice.decade_text(-15, -3)});
  if (dice.one_in(4)) options.push_back({"--local-error", dice.decade_text(-15, -2)});
  if (dice.one_in(4))
    options.push_back({"--longest", dice.decade_text(-3, extreme ? 5 : 0)});
  if (dice.one_in(4))
    options.push_back({"--step", dice.decade_text(extreme ? -12 : -6, -1)});
  return options;
}

std::vector<Option> response_options(Dice& dice, bool extreme)
{
  const double from = dice.decade(extreme ? -4 : 0, extreme ? 4 : 1.5);
  const double to = from * (1 + dice.decade(-3, extreme ? 4 : 0.5));
  std::vector<Option> options{{"--from", format("%.6e", from)},
                              {"--to", format("%.6e", to)}};
  if (dice.one_in(2))
    options.push_back({"--harmonics", whole(dice, 0, extreme ? 2.5 : 1)});
  if (dice.one_in(4)) options.push_back({"--samples", whole(dice, 1, extreme ? 5 : 3)});
  if (dice.one_in(4))
    options.push_back({"--newton-tolerance", dice.decade_text(-15, -3)});
  if (dice.one_in(4)) options.push_back({"--direction", dice.one_in(2) ? "up" : "down"});
  if (dice.one_in(8)) options.push_back({"--isolated", whole(dice, 0, 1)});
  return options;
}

/** One to three options wrong: in value, in name, missing or twice. */
void spoil(Dice& dice, std::vector<Option>& options)
{
  for (int k = 1 + dice.roll(3); k > 0 && !options.empty(); --k) {
    const int at = dice.roll(static_cast<int>(options.size()));
    const Option chosen = options[at];
    switch (dice.roll(8)) {
      case 0:
        options.erase(options.begin() + at);
        break;
      case 1:
        options.push_back(chosen);
        break;
      case 2:
        options[at].name += dice.pick<std::string>({"s", "=", " ", "-", "é"});
        break;
      case 3:
        options[at].name = dice.pick<std::string>({"--colour", "-f", "--", "--from"});
        break;
      default:
        options[at].value = odd_word(dice);
        break;
    }
  }
}

std::string parameter_path(Dice& dice)
{
  if (dice.one_in(4)) return std::string(1 + dice.roll(9000), dice.one_in(2) ? 'p' : '/');
  return dice.pick(odd_paths());
}

}  // namespace

std::string FuzzCase::command() const
{
  std::string line;
  for (const std::string& word : arguments)
    line += (line.empty() ? "'" : " '") + word + "'";
  return line;
}

FuzzCase fuzz_case(std::uint64_t seed, Fuzz kind, const std::string& work)
{
  Dice dice(seed);
  FuzzCase made;
  made.file =
      kind == Fuzz::file ? spoilt_file(dice) : legal_file(dice, kind == Fuzz::extreme);

  std::string command = dice.pick<std::string>({"orbit", "orbit", "contact", "response"});
  const bool extreme = kind == Fuzz::extreme;
  auto options = command == "response" ? response_options(dice, extreme)
                                       : motion_options(dice, extreme);
  std::string path = "machine.toml";
  if (kind == Fuzz::options) {
    spoil(dice, options);
    if (dice.one_in(12)) path = parameter_path(dice);
    if (dice.one_in(20)) command = odd_word(dice);
  }
  made.arguments = {"explore", command, path};
  for (const Option& option : options) {
    made.arguments.push_back(option.name);
    made.arguments.push_back(option.value);
  }
  if (kind == Fuzz::options && dice.one_in(8)) made.arguments.push_back(odd_word(dice));
  if (!work.empty() && command == "response" && dice.one_in(4))
    made.arguments.push_back("--stability");
  if (!work.empty()) made.arguments.insert(made.arguments.end(), {"--budget", work});
  return made;
}

}  // namespace rotor_stator::tests
