#include "core/base/program_pages.h"

#ifdef __linux__
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#endif

namespace scantrove {

#ifdef __linux__
namespace {

/// The loader gives addresses as numbers.
void* pointerTo(std::uintptr_t address) {
  return reinterpret_cast<void*>(address);  // NOLINT(performance-no-int-to-ptr)
}

/// The loader wrote into its code: the file does not hold what is in memory.
bool hasChangedCode(const dl_phdr_info& object) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = object.dlpi_phdr[i];
    if (header.p_type != PT_DYNAMIC) continue;
    const auto* entry = static_cast<const ElfW(Dyn)*>(pointerTo(object.dlpi_addr + header.p_vaddr));
    for (; entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_TEXTREL) return true;
      if (entry->d_tag == DT_FLAGS && (entry->d_un.d_val & DF_TEXTREL) != 0) return true;
    }
  }
  return false;
}

/// A debugger writes its breakpoints into the code: they would be lost.
bool isTraced() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (long tracer = 0; word == "TracerPid:" && status >> tracer) return tracer != 0;
  }
  return false;
}

int releasePagesOf(dl_phdr_info* object, std::size_t /*size*/, void* /*nothing*/) {
  if (hasChangedCode(*object)) return 0;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = object->dlpi_phdr[i];
    if (header.p_type != PT_LOAD || (header.p_flags & PF_W) != 0) continue;
    const std::uintptr_t begin = (object->dlpi_addr + header.p_vaddr) / page * page;
    const std::uintptr_t end = object->dlpi_addr + header.p_vaddr + header.p_memsz;
    // A failure means that they stay: no harm.
    ::madvise(pointerTo(begin), end - begin, MADV_DONTNEED);
  }
  return 0;
}

}  // namespace

void releaseProgramPages() {
  if (!isTraced()) ::dl_iterate_phdr(releasePagesOf, nullptr);
}
#else
void releaseProgramPages() {}
#endif

}  // namespace scantrove
