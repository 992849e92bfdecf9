#include "base/io/release_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace wrlkit {
namespace {

/// Whether pages that are there can be read and not written: only those of a file are like that. A system that cannot
/// tell (before Linux 5.14) says no.
bool is_of_file(void* page, std::size_t size) {
#if defined(MADV_POPULATE_READ) && defined(MADV_POPULATE_WRITE)
  return madvise(page, size, MADV_POPULATE_READ) == 0 && madvise(page, size, MADV_POPULATE_WRITE) != 0;
#else
  return false;
#endif
}

}  // namespace

void release_pages(std::string_view part) {
  const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(part.data());
  const auto first = (address + size - 1) / size * size, end = (address + part.size()) / size * size;
  if (first >= end) return;
  void* const page = const_cast<char*>(part.data()) + (first - address);
  if (is_of_file(page, size)) madvise(page, end - first, MADV_DONTNEED);
}

}  // namespace wrlkit
