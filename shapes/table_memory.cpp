#include "shapes/table_memory.h"

#include <algorithm>
#include <bit>
#include <map>
#include <memory_resource>
#include <mutex>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace gjkdbg {
namespace {

constexpr std::size_t large_page = std::size_t{1} << 21, alignment = 128;

/// Whole large pages, where the system has them.
class LargePages final : public std::pmr::memory_resource {
  void* do_allocate(std::size_t bytes, std::size_t) override {
    const std::size_t whole = (bytes + large_page - 1) / large_page * large_page;
    void* const memory = ::operator new(whole, std::align_val_t{large_page});
#ifdef MADV_HUGEPAGE
    madvise(memory, whole, MADV_HUGEPAGE);  // advice: without it the pages are small
#endif
    return memory;
  }
  void do_deallocate(void* memory, std::size_t, std::size_t) override { ::operator delete(memory, std::align_val_t{large_page}); }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

/// Sizes in steps of an eighth of the next lower power of two: no more are told apart, and no more than an eighth is left unused.
std::size_t size_class(std::size_t bytes) {
  const std::size_t step = std::max(alignment, std::bit_floor(bytes) / 8);
  return (bytes + step - 1) / step * step;
}

class TableMemory {
 public:
  void* take(std::size_t bytes) {
    const std::size_t size = size_class(bytes);
    const std::lock_guard lock(mutex_);
    Free*& free = free_[size];
    if (free == nullptr) return fresh_.allocate(size, alignment);
    return std::exchange(free, free->next);
  }
  /// The size was asked for before: nothing is allocated.
  void give_back(void* memory, std::size_t bytes) noexcept {
    const std::lock_guard lock(mutex_);
    Free*& free = free_.find(size_class(bytes))->second;
    free = new (memory) Free{free};
  }

 private:
  struct Free {
    Free* next;
  };
  std::mutex mutex_;
  LargePages pages_;
  std::pmr::monotonic_buffer_resource fresh_{large_page, &pages_};
  std::map<std::size_t, Free*> free_;
};

/// Never destroyed: a hull may outlive it else.
TableMemory& table_memory() {
  static TableMemory& memory = *new TableMemory;
  return memory;
}

}  // namespace

void* take_table_memory(std::size_t bytes) { return table_memory().take(bytes); }
void give_table_memory_back(void* memory, std::size_t bytes) noexcept { table_memory().give_back(memory, bytes); }

}  // namespace gjkdbg
