// What urls are written as in one output: those of copies of the files that they lead to, or the data themselves.
#pragma once
#include <optional>
#include <set>
#include <string>

#include "convert/writing.h"
#include "writers/copied_files.h"
#include "writers/led_urls.h"

namespace wrlkit {

class OutputUrls {
 public:
  /// `textures`: those of ImageTextures, too, which glTF holds itself.
  OutputUrls(const Writing&, bool textures);

  /// The url of a copy, or the data; nothing when the url is to lead to where the file is.
  std::optional<std::string> operator()(std::string_view url, Span where, UrlUse use);
  bool write() { return !copies_ || copies_->write(); }
  /// The output is written.
  void keep() {
    if (copies_) copies_->keep();
  }

 private:
  std::optional<std::string> data_of(std::string_view url, Span where);
  std::optional<std::string> led_from_nowhere(std::string_view url, Span where);
  void report_not_embedded(const std::string& copy, Span where, UrlUse use);

  const Writing& writing_;
  bool textures_;
  std::optional<CopiedFiles> copies_;
  std::set<std::string> not_embedded_;  // of those that have been reported
};

}  // namespace wrlkit
