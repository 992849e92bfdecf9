#include "parsers/vrml/deferred_lists.h"

#include <algorithm>

#include "parsers/vrml/lexer.h"
#include "parsers/vrml/plain_numbers.h"

namespace wrlkit::vrml {
namespace {

constexpr std::size_t smallest_batch = 64 * 1024, largest_batch = 2 * 1024 * 1024;

/// The pieces of one list, one behind the other.
template <class T>
const T* joined(std::span<const std::span<const T>> pieces, std::size_t count, Arena& arena) {
  if (pieces.size() == 1) return pieces[0].data();
  T* const all = arena.allocate<T>(count);
  T* to = all;
  for (const auto piece : pieces) to = std::ranges::copy(piece, to).out;
  return all;
}

}  // namespace

DeferredLists::DeferredLists(std::string_view text, const PartRead& part_read)
    : batch_bytes_(std::clamp(text.size() / 32, smallest_batch, largest_batch)), part_read_(part_read) {
  batches_.push_back({text.data(), text.data()});
}

DeferredLists::~DeferredLists() {
  failed_ = true;
  threads_.wait();
}

Value DeferredLists::add(std::string_view list, FieldType type, std::uint16_t slot, NodeId node) {
  Value v;
  v.type = type;
  v.slot = slot;
  v.chars = list.data();
  const bool real = info(type).element == Element::number;
  const auto next = static_cast<std::uint32_t>(different_.size());
  const auto id = repeated_.find_or_add(list, real, next);
  lists_.push_back({node, id, v});
  if (id == next) add_pieces(list, real);
  batches_.back().end = list.data() + list.size();
  if (static_cast<std::size_t>(batches_.back().end - batches_.back().begin) >= batch_bytes_) begin_last();
  return v;
}

void DeferredLists::add_pieces(std::string_view list, bool real) {
  different_.emplace_back();
  while (!list.empty()) {
    // Cut at a blank. One that is in a comment does no harm, because lists with comments are not read here.
    std::size_t n = std::min(list.size(), batch_bytes_);
    while (n < list.size() && class_of(list[n]) != CharClass::blank) ++n;
    batches_.back().pieces.push_back({list.substr(0, n), real, {}});
    batches_.back().end = list.data() + n;
    list.remove_prefix(n);
    ++different_.back().n_pieces;
    if (!list.empty()) begin_last();
  }
}

void DeferredLists::begin_last() {
  threads_.run([this, &batch = batches_.back()] { read(batch); });
  const char* const end = batches_.back().end;
  batches_.push_back({end, end});
}

void DeferredLists::read(Batch& batch) {
  std::vector<double> numbers;
  std::vector<std::int32_t> integers;
  for (Piece& piece : batch.pieces) {
    if (failed_) return;
    const char* const end = piece.text.data() + piece.text.size();
    const bool good =
        piece.real ? read_plain_list(piece.text, end, numbers) : read_plain_list(piece.text, end, integers);
    if (!good) return give_up();
    piece.numbers = piece.real ? batch.memory.make(FieldType::MFDouble, 0, numbers)
                               : batch.memory.make(FieldType::MFInt32, 0, integers);
  }
  if (part_read_) part_read_({batch.begin, static_cast<std::size_t>(batch.end - batch.begin)});
}

void DeferredLists::join(Scene& scene) {
  std::vector<std::span<const double>> reals;
  std::vector<std::span<const std::int32_t>> integers;
  auto to = different_.begin();
  for (const Batch& batch : batches_) {
    scene.import(batch.memory);
    for (const Piece& piece : batch.pieces) {
      to->count += piece.numbers.count;
      if (piece.real)
        reals.push_back(piece.numbers.number_span());
      else
        integers.push_back(piece.numbers.integer_span());
      if (reals.size() + integers.size() < to->n_pieces) continue;
      to->numbers = piece.real ? static_cast<const void*>(joined<double>(reals, to->count, scene.arena()))
                               : joined<std::int32_t>(integers, to->count, scene.arena());
      reals.clear();
      integers.clear();
      ++to;
    }
  }
}

bool DeferredLists::put(const List& list, Scene& scene) const {
  const Different& read = different_[list.different];
  const auto& type = info(list.stand_in.type);
  if (read.count % type.arity != 0) return false;
  const Value* now = scene.find(list.node, list.stand_in.slot);
  if (!now || now->count != 0 || now->chars != list.stand_in.chars) return true;  // another value came behind it
  Value v = list.stand_in;
  v.count = static_cast<std::uint32_t>(read.count / type.arity);
  if (type.element == Element::number)
    v.numbers = static_cast<const double*>(read.numbers);
  else
    v.integers = static_cast<const std::int32_t*>(read.numbers);
  scene.set(list.node, v);
  return true;
}

bool DeferredLists::finish(Scene& scene) {
  begin_last();
  threads_.wait();
  if (failed_) return false;
  join(scene);
  return std::ranges::all_of(lists_, [&](const List& list) { return put(list, scene); });
}

}  // namespace wrlkit::vrml
