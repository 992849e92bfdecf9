#include "base/lazy_library.h"

#include <dlfcn.h>

namespace wrlkit {

LazyLibrary::LazyLibrary(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) fault_ = dlerror();
}

void* LazyLibrary::find(const char* name) {
  void* const function = handle_ ? dlsym(handle_, name) : nullptr;
  if (!function && fault_.empty()) fault_ = dlerror();
  return function;
}

}  // namespace wrlkit
