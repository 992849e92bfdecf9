// Bytes to gzip data (RFC 1952), piece by piece; without time and name, so that the same bytes give the same data.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace wrlkit {

class Gzip {
 public:
  /// Takes packed bytes; 0, or an error (errno).
  using Put = std::function<int(std::string_view)>;

  Gzip();
  ~Gzip();

  /// Packs a piece; `last` also ends the data. 0, or the error of `put`.
  int pack(std::string_view piece, bool last, const Put& put);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All at once.
std::string gzipped(std::string_view bytes);
/// How many bytes all of them would become.
std::uint64_t gzipped_size(std::span<const std::string_view> pieces);

}  // namespace wrlkit
