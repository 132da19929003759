// The memory of tables of directions (shapes/hull_core.h), in large pages.
//
// A query looks at a few lines of a table, each in another page of 4 KB, and of many hulls no processor keeps so many pages' addresses: each
// look then waits for the address before it waits for the line. In pages of 2 MB there is one address for dozens of tables.
// What is given back is kept for tables of the same size: they are as many as there were at once.
#pragma once

#include <cstddef>

namespace gjkdbg {

/// At least `bytes` bytes, aligned to 128; throws std::bad_alloc. From any thread.
void* take_table_memory(std::size_t bytes);
/// For the next one; `bytes` as it was asked for.
void give_table_memory_back(void* memory, std::size_t bytes) noexcept;

/// For containers of what is read a line at a time.
template <class T>
struct TableAllocator {
  using value_type = T;
  TableAllocator() = default;
  template <class U>
  TableAllocator(const TableAllocator<U>&) {}  // implicit on purpose: containers turn one into another
  T* allocate(std::size_t n) { return static_cast<T*>(take_table_memory(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) noexcept { give_table_memory_back(p, n * sizeof(T)); }
  template <class U>
  bool operator==(const TableAllocator<U>&) const {
    return true;
  }
};

}  // namespace gjkdbg
