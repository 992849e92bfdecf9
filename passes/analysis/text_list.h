// Names for a message: the first few of them, and how many there are.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

class TextList {
 public:
  void add(std::string_view s) {
    if (++n_ > most) return;
    if (!text_.empty()) text_ += ' ';
    text_ += s;
  }
  bool empty() const { return n_ == 0; }
  std::size_t count() const { return n_; }
  /// "A B C ..."
  std::string text() const { return n_ > most ? text_ + " ..." : text_; }

 private:
  static constexpr std::size_t most = 8;
  std::string text_;
  std::size_t n_ = 0;
};

}  // namespace wrlkit
