#include "base/io/uri.h"

namespace wrlkit {

std::string uri_of(std::string_view file_name) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~",
                             hex = "0123456789ABCDEF";
  std::string uri;
  for (unsigned char c : file_name) {
    if (plain.find(static_cast<char>(c)) != plain.npos)
      uri += static_cast<char>(c);
    else
      ((uri += '%') += hex[c >> 4]) += hex[c & 15];
  }
  return uri;
}

}  // namespace wrlkit
