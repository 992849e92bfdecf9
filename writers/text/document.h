// A file of VRML or X3D as it is printed: its lines, which of its nodes are printed already, and numbers. How nodes,
// fields and strings look is the writers' own.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "base/io/sink.h"
#include "base/text/backslash.h"
#include "scenegraph/urls.h"
#include "writers/text/names.h"

namespace wrlkit {

class TextDocument {
 protected:
  struct Style {
    Dialect dialect;
    std::string_view yes, no;           // of SFBool
    std::string_view between_tuples{};  // of a list, in addition to a blank
    bool wraps_images = false;
  };

  TextDocument(const Scene& scene, const Style& style, bool own_fields, int precision, const Sink& sink, Diagnostics&);

  TextOut& line();
  /// What `print` prints stands one step to the right.
  template <class Print>
  void indented(Print print) {
    ++depth_;
    print();
    --depth_;
  }

  /// Whether the scope that is being printed has it already.
  bool is_printed(NodeId n) const { return printed_[n.value] == scope_; }
  void set_printed(NodeId n);

  /// Prints the body of a prototype, which knows nothing of what is printed around it and leaves that known behind it.
  template <class Print>
  void body(Print print) {
    const auto around = std::exchange(scope_, ++scopes_);
    const auto mark = again_.size();
    print();
    for (; again_.size() > mark; again_.pop_back()) printed_[again_.back().first] = again_.back().second;
    scope_ = around;
  }

  /// Where the fields that a Script declares itself begin.
  std::size_t own_fields(const NodeType& t) const;
  /// None: it is not a list of urls.
  UrlUse url_use(TypeId type, std::uint16_t slot, const Value& v) const {
    return v.is || v.type != FieldType::MFString ? UrlUse::none : urls_.use(type, slot);
  }

  /// Numbers, images and truth, of one tuple or of many; without brackets.
  void numbers(const Value& v);
  /// In quotes; put(text) prints what needs no backslash.
  template <class Put>
  void quoted(std::string_view s, Put put) {
    out_ << '"';
    by_escapes(s, put, [&](char c) { out_ << '\\' << c; });
    out_ << '"';
  }

  /// Reports what could not be written as it is.
  void end();

  const Scene& scene_;
  Diagnostics& diag_;
  UrlFields urls_;
  TextOut out_;
  Names names_;
  int depth_ = 0;

 private:
  template <class T, class Print>
  void list(std::span<const T> values, std::size_t arity, Print print);
  void pixel(std::uint32_t);
  void number(double);

  Style style_;
  int precision_;
  std::size_t n_not_finite_ = 0;
  std::vector<std::uint32_t> printed_;                          // the scope that printed the node last, from 1
  std::vector<std::pair<std::uint32_t, std::uint32_t>> again_;  // nodes printed again in a body, and where before
  std::uint32_t scope_ = 1, scopes_ = 1;
};

}  // namespace wrlkit
