#include "io/files/cut_pages.h"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>

namespace folprom::io {
namespace {

// The handler may only look: no lock, no allocation.
struct Mapping {
  std::atomic<uintptr_t> begin{0};  // 0: free
  std::atomic<uintptr_t> end{0};    // 0: about to be known
};
std::array<Mapping, 1024> mappings;
std::atomic<bool> is_installed{false};
uintptr_t page_bytes = 4096;

bool IsMapped(uintptr_t address) {
  for (const Mapping& mapping : mappings) {
    if (address >= mapping.begin && address < mapping.end) return true;
  }
  return false;
}

void PutZeros(int, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<uintptr_t>(info->si_addr);
  void* const page = reinterpret_cast<void*>(address / page_bytes * page_bytes);
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
  if (IsMapped(address) && ::mmap(page, page_bytes, PROT_READ, kFlags, -1, 0) != MAP_FAILED) return;
  // The same access comes again, and ends the program.
  ::signal(SIGBUS, SIG_DFL);
}

}  // namespace

void ReadCutPagesAsZeros() {
  if (is_installed.exchange(true)) return;
  page_bytes = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
  struct sigaction action = {};
  action.sa_sigaction = PutZeros;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

void AddMapping(const void* begin, size_t size) {
  if (!is_installed) return;
  const auto first = reinterpret_cast<uintptr_t>(begin);
  for (Mapping& mapping : mappings) {
    uintptr_t free = 0;
    if (!mapping.begin.compare_exchange_strong(free, first)) continue;
    mapping.end = first + size;
    return;
  }
}

void RemoveMapping(const void* begin) {
  const auto first = reinterpret_cast<uintptr_t>(begin);
  for (Mapping& mapping : mappings) {
    if (mapping.begin != first) continue;
    mapping.end = 0;
    mapping.begin = 0;
    return;
  }
}

}  // namespace folprom::io
