// Memory for the arrays of a scene: allocated once, never moved, never written again after the call that filled it,
// freed all together. Because of that, scenes share arenas when they are copied or imported into each other.
#pragma once
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace wrlkit {

class Arena {
 public:
  /// Uninitialised room for n values of T. Amortised O(1); arrays above half a block get a block of their own, so that
  /// no more than a block is ever wasted.
  template <class T>
  T* allocate(std::size_t n) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignof(std::max_align_t));
    return static_cast<T*>(bytes(n * sizeof(T), alignof(T)));
  }

  template <class T>
  const T* copy(std::span<const T> from) {
    if (from.empty()) return nullptr;
    T* to = allocate<T>(from.size());
    std::memcpy(static_cast<void*>(to), from.data(), from.size_bytes());
    return to;
  }

  std::string_view copy(std::string_view s) { return {copy(std::span<const char>(s.data(), s.size())), s.size()}; }

 private:
  static constexpr std::size_t block = 256 * 1024;

  void* bytes(std::size_t n, std::size_t align) {
    std::size_t at = (used_ + align - 1) & ~(align - 1);
    if (at + n <= size_) {
      used_ = at + n;
      return current_ + at;
    }
    if (n > block / 2) {
      blocks_.push_back(std::unique_ptr<std::byte[]>(new std::byte[n]));
      return blocks_.back().get();
    }
    blocks_.push_back(std::unique_ptr<std::byte[]>(new std::byte[block]));
    current_ = blocks_.back().get();
    size_ = block;
    used_ = n;
    return current_;
  }

  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::byte* current_ = nullptr;
  std::size_t size_ = 0, used_ = 0;
};

}  // namespace wrlkit
