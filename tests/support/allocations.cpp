#include "support/allocations.hpp"

#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define COUNTS_ALLOCATIONS 1
#else
#define COUNTS_ALLOCATIONS 0
#endif

namespace {

thread_local long count = 0;

}  // namespace

#if COUNTS_ALLOCATIONS
extern "C" {

/** What glibc's malloc and its kin are called inside glibc. */
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size)
{
  ++count;
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size)
{
  ++count;
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size)
{
  ++count;
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size)
{
  ++count;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size)
{
  ++count;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace rotor_stator::tests {

bool counts_allocations()
{
  return COUNTS_ALLOCATIONS;
}

long allocations()
{
  return count;
}

}  // namespace rotor_stator::tests
