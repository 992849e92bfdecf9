// Shared libraries that are opened when something in them is needed for the first time. Most conversions trace no rays
// and cut no letters, and opening the libraries for that takes longer than converting a small file.
#pragma once
#include <string>

namespace wrlkit {

class LazyLibrary {
 public:
  /// Opens "libfreetype.so.6", say, where the dynamic linker finds it. It stays open until the program ends. Any
  /// thread.
  explicit LazyLibrary(const char* name);

  /// Why it could not be opened, or a function was not in it; empty: all went well.
  const std::string& fault() const { return fault_; }

  /// Sets a pointer to a function of the library; null: there is no such function, or no library.
  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(find(name));
  }

 private:
  void* find(const char* name);

  void* handle_;
  std::string fault_;
};

}  // namespace wrlkit
