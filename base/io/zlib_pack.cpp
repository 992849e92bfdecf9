// What the PNG writer of the scene graph, which knows no third-party library, asks for.
#include <zlib.h>

#include <new>

#include "base/image/png.h"

namespace wrlkit {

std::string zlib_packed(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

}  // namespace wrlkit
