// The bytes of a file: filled once, immutable afterwards, shared by copies. std::string would write zeros over 100 MB
// before the file is read into it. Memory comes from the system in pages, and asks for huge ones, which make the first
// touch of 100 MB four times as fast (40 ms to 9 ms). It grows by moving pages, not bytes; realloc copies them when
// they are huge.
#pragma once
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string_view>
#include <utility>

namespace wrlkit {

class Buffer {
 public:
  Buffer() = default;
  std::string_view view() const { return {data_.get(), size_}; }

 private:
  friend class BufferBuilder;
  std::shared_ptr<const char> data_;
  std::size_t size_ = 0;
};

/// A Buffer that is being filled. Grows by a quarter; pages that were reserved and never written cost nothing.
class BufferBuilder {
 public:
  BufferBuilder() = default;
  ~BufferBuilder() {
    if (data_) munmap(data_, capacity_);
  }
  BufferBuilder(const BufferBuilder&) = delete;

  char* end() { return data_ + size_; }
  std::size_t size() const { return size_; }
  std::size_t room() const { return capacity_ - size_; }
  std::string_view view() const { return {data_, size_}; }
  void added(std::size_t n) { size_ += n; }
  void cut(std::size_t n) { size_ = n; }

  /// Room for `capacity` bytes in all; false: there is not that much memory.
  bool reserve(std::size_t capacity) { return capacity <= capacity_ || resize(whole_pages(capacity)); }
  bool grow() { return resize(whole_pages(capacity_ + std::max(capacity_ / 4, smallest))); }

  /// Hands the bytes over; what was reserved too much goes back.
  Buffer finish() {
    Buffer done;
    if (size_ == 0) return done;
    if (whole_pages(size_) < capacity_) resize(whole_pages(size_));
    done.data_.reset(data_, [n = capacity_](char* p) { munmap(p, n); });
    done.size_ = std::exchange(size_, 0);
    data_ = nullptr;
    capacity_ = 0;
    return done;
  }

 private:
  static constexpr std::size_t smallest = 64 * 1024, huge_from = 4 * 1024 * 1024;

  static std::size_t whole_pages(std::size_t n) {
    constexpr std::size_t page = 64 * 1024;  // no system has larger ones
    return (n + page - 1) / page * page;
  }

  bool resize(std::size_t capacity) {
    void* p = data_ ? mremap(data_, capacity_, capacity, MREMAP_MAYMOVE)
                    : mmap(nullptr, capacity, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) return false;
    data_ = static_cast<char*>(p);
    capacity_ = capacity;
    if (capacity_ >= huge_from) madvise(data_, capacity_, MADV_HUGEPAGE);
    return true;
  }

  char* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace wrlkit
