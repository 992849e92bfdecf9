// Lists of numbers that other threads read while the parser goes on behind them. That works for lists that are written
// plainly to their brackets, which are nearly all. Where one is not, nothing of this reading of the file counts, and
// the file is read again on one thread: so there is one place only that repairs numbers and reports it.
#pragma once
#include <atomic>
#include <deque>
#include <span>
#include <vector>

#include "base/background.h"
#include "parsers/vrml/parser.h"
#include "parsers/vrml/repeated_lists.h"
#include "scenegraph/scene.h"

namespace wrlkit::vrml {

class DeferredLists {
 public:
  /// Threads are worth their while from that many bytes of text on.
  static constexpr std::size_t from_bytes = std::size_t{1} << 20;

  /// Of a text, which has to live until `finish`.
  DeferredLists(std::string_view text, const PartRead&);
  ~DeferredLists();

  /// The text between the brackets of a field of a node, whose Value is a stand-in for now.
  Value add(std::string_view list, FieldType, std::uint16_t slot, NodeId);
  /// The file has to be read again on one thread.
  void give_up() { failed_ = true; }
  /// Whether a thread gave up, or some list turned out to be written otherwise; the parser may stop then.
  bool failed() const { return failed_; }
  /// Waits, and puts the values into the fields of their nodes. False: failed().
  bool finish(Scene&);

 private:
  /// A part of a list; all but very long ones have one.
  struct Piece {
    std::string_view text;
    bool real;
    Value numbers;
  };
  /// What one thread reads at once: the lists of a part of the text. The scene has no nodes, but the memory of the
  /// values.
  struct Batch {
    const char* begin;
    const char* end;
    std::vector<Piece> pieces{};
    Scene memory{};
  };
  /// Different lists are read, each of them for all fields that have it.
  struct Different {
    std::size_t n_pieces = 0;
    const void* numbers = nullptr;
    std::size_t count = 0;
  };
  struct List {
    NodeId node;
    std::uint32_t different;
    Value stand_in;
  };
  void add_pieces(std::string_view list, bool real);
  void begin_last();
  void read(Batch&);
  void join(Scene&);
  bool put(const List&, Scene&) const;

  std::size_t batch_bytes_;
  const PartRead& part_read_;
  std::atomic<bool> failed_ = false;
  std::deque<Batch> batches_;
  RepeatedLists repeated_;
  std::deque<Different> different_;
  std::deque<List> lists_;
  Background threads_;
};

}  // namespace wrlkit::vrml
