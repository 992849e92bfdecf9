#include "convert/load.h"

namespace wrlkit {

Document load(const std::string& path, LoadOptions options, Watch watch) {
  Document document(std::move(options), std::move(watch));
  document.read(path);
  return document;
}

Document load_bytes(std::string_view bytes, std::string name, LoadOptions options, Watch watch) {
  Document document(std::move(options), std::move(watch));
  document.parse(bytes, std::move(name));
  return document;
}

}  // namespace wrlkit
