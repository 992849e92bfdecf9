// What was wrong, what was repaired and what was lost. Library code reports here and goes on; printing is the caller's.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/source.h"

namespace wrlkit {

enum class Severity : std::uint8_t { ignored, note, lost, warning, error };

enum class Diag : std::uint8_t {
#define DIAG(severity, name, text) name,
#include "base/diagnostics.def"
#undef DIAG
  count_
};

struct DiagInfo {
  Diag id;
  std::string name;  // with '-'
  Severity severity;
  std::string_view text;
};
/// All of them, in the order of diagnostics.def.
std::span<const DiagInfo> all_diags();
const DiagInfo& info(Diag);
bool find_diag(std::string_view name, Diag& out);
std::string_view to_string(Severity);
/// The text of a message with {} in place of what differs.
std::string general_text(const DiagInfo&);

struct Message {
  Diag id;
  Severity severity;
  Span where;
  std::vector<std::string> args;
  std::string text() const;
};

class Diagnostics {
 public:
  /// Messages kept of one name; the others are only counted.
  static constexpr std::size_t kept_per_name = 3;
  /// Messages that are known again when they are reported a second time; any beyond are counted each time.
  static constexpr std::size_t remembered = 1'000'000;

  explicit Diagnostics(std::shared_ptr<Sources> sources = std::make_shared<Sources>()) : sources_(std::move(sources)) {
    for (std::size_t i = 0; i < severity_.size(); ++i) severity_[i] = info(static_cast<Diag>(i)).severity;
  }

  template <class... A>
  void report(Diag id, Span where, const A&... args) {
    add(id, where, {argument(args)...});
  }

  /// Severity of one message from now on (-Werror=NAME, -Wno-NAME).
  void set_severity(Diag id, Severity s) { severity_[static_cast<std::size_t>(id)] = s; }
  /// Every warning is an error from now on (--strict).
  void warnings_are_errors();

  bool has_errors() const { return count(Severity::error) > 0; }
  std::size_t count(Severity s) const { return by_severity_[static_cast<std::size_t>(s)]; }
  /// Of any severity.
  std::size_t count() const { return std::accumulate(by_severity_.begin(), by_severity_.end(), std::size_t{0}); }
  std::size_t count(Diag id) const { return by_name_[static_cast<std::size_t>(id)]; }
  std::span<const Message> messages() const { return messages_; }
  Sources& sources() const { return *sources_; }
  const std::shared_ptr<Sources>& shared_sources() const { return sources_; }

 private:
  static std::string argument(std::string_view s);
  static std::string argument(const char* s) { return argument(std::string_view(s)); }
  static std::string argument(const std::string& s) { return argument(std::string_view(s)); }
  static std::string argument(double v);
  static std::string argument(float v) { return argument(static_cast<double>(v)); }
  template <class I>
  requires std::is_integral_v<I>
  static std::string argument(I v) { return std::to_string(v); }
  void add(Diag, Span, std::vector<std::string>);

  static constexpr std::size_t n_ = static_cast<std::size_t>(Diag::count_);
  std::shared_ptr<Sources> sources_;
  std::array<Severity, n_> severity_;
  std::array<std::size_t, n_> by_name_{};
  std::array<std::size_t, 5> by_severity_{};
  std::vector<Message> messages_;
  std::unordered_set<std::uint64_t> reported_;  // hashes of what has a place, as far as they are remembered
};

}  // namespace wrlkit
