#include "output/provenance.hpp"

#include "source_revision.hpp"

namespace rotor_stator
{

std::string source_revision()
{
  return ROTOR_STATOR_REVISION;
}

std::string compiler()
{
  return "g++ " __VERSION__ " " ROTOR_STATOR_FLAGS;
}

}  // namespace rotor_stator
