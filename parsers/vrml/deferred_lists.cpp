#include "parsers/vrml/deferred_lists.h"

#include <algorithm>

#include "parsers/vrml/lexer.h"
#include "parsers/vrml/number.h"
#include "parsers/vrml/plain_numbers.h"

namespace wrlkit::vrml {
namespace {

constexpr std::size_t smallest_batch = 64 * 1024, largest_batch = 2 * 1024 * 1024;

NumberResult read_number(const char*& p, const char* end, double& out) { return read_double(p, end, out); }
NumberResult read_number(const char*& p, const char* end, std::int32_t& out) { return read_int32(p, end, out); }

/// False when there is anything but numbers and blanks, or a number that has to be repaired.
template <class T>
bool read_list(std::string_view text, std::vector<T>& to) {
  to.clear();
  const char* p = text.data();
  const char* const end = p + text.size();
  for (;;) {
    p = read_plain_numbers(p, end, to);
    while (p < end && class_of(*p) == CharClass::blank) ++p;
    if (p == end) return true;
    T v;
    if (read_number(p, end, v) != NumberResult::exact) return false;
    to.push_back(v);
  }
}

/// The pieces of one list, one behind the other.
template <class T>
const T* joined(std::span<const T> first, std::size_t count, auto&& pieces, Scene& scene) {
  if (pieces.size() == 1) return first.data();
  T* const all = scene.arena().allocate<T>(count);
  T* to = all;
  for (const auto* piece : pieces) {
    if constexpr (std::is_same_v<T, double>)
      to = std::ranges::copy(piece->numbers.number_span(), to).out;
    else
      to = std::ranges::copy(piece->numbers.integer_span(), to).out;
  }
  return all;
}

}  // namespace

DeferredLists::DeferredLists(std::size_t bytes, const PartRead& part_read)
    : batch_bytes_(std::clamp(bytes / 32, smallest_batch, largest_batch)), part_read_(part_read) {}

DeferredLists::~DeferredLists() {
  failed_ = true;
  threads_.wait();
}

Value DeferredLists::add(std::string_view list, FieldType type, std::uint16_t slot, NodeId node) {
  Value v;
  v.type = type;
  v.slot = slot;
  v.chars = list.data();
  lists_.push_back({node, v, 0});
  const bool real = info(type).element == Element::number;
  while (!list.empty()) {
    // Cut at a blank. One that is in a comment does no harm, because lists with comments are not read here.
    std::size_t n = std::min(list.size(), batch_bytes_);
    while (n < list.size() && class_of(list[n]) != CharClass::blank) ++n;
    add_piece(list.substr(0, n), real);
    list.remove_prefix(n);
    ++lists_.back().n_pieces;
  }
  return v;
}

void DeferredLists::add_piece(std::string_view text, bool real) {
  if (batches_.empty() || batches_.back().bytes >= batch_bytes_) {
    begin_last();
    batches_.emplace_back();
  }
  batches_.back().pieces.push_back({text, real, {}});
  batches_.back().bytes += text.size();
}

void DeferredLists::begin_last() {
  if (!batches_.empty()) threads_.run([this, &batch = batches_.back()] { read(batch); });
}

void DeferredLists::read(Batch& batch) {
  std::vector<double> numbers;
  std::vector<std::int32_t> integers;
  for (Piece& piece : batch.pieces) {
    if (failed_) return;
    const bool good = piece.real ? read_list(piece.text, numbers) : read_list(piece.text, integers);
    if (!good) return give_up();
    piece.numbers = piece.real ? batch.memory.make(FieldType::MFDouble, 0, numbers)
                               : batch.memory.make(FieldType::MFInt32, 0, integers);
  }
  const auto first = batch.pieces.front().text, last = batch.pieces.back().text;
  if (part_read_) part_read_({first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data())});
}

bool DeferredLists::put(const List& list, std::span<const Piece* const> pieces, Scene& scene) {
  const auto arity = info(list.stand_in.type).arity;
  std::size_t count = 0;
  for (const auto* piece : pieces) count += piece->numbers.count;
  if (count % arity != 0) return false;
  const Value* now = scene.find(list.node, list.stand_in.slot);
  if (!now || now->count != 0 || now->chars != list.stand_in.chars) return true;  // another value came behind it
  Value v = list.stand_in;
  v.count = static_cast<std::uint32_t>(count / arity);
  if (pieces[0]->real)
    v.numbers = joined(pieces[0]->numbers.number_span(), count, pieces, scene);
  else
    v.integers = joined(pieces[0]->numbers.integer_span(), count, pieces, scene);
  scene.set(list.node, v);
  return true;
}

bool DeferredLists::finish(Scene& scene) {
  begin_last();
  threads_.wait();
  if (failed_) return false;
  std::vector<const Piece*> pieces;
  for (const Batch& batch : batches_) {
    scene.import(batch.memory);
    for (const Piece& piece : batch.pieces) pieces.push_back(&piece);
  }
  std::span<const Piece* const> rest = pieces;
  for (const List& list : lists_) {
    if (!put(list, rest.first(list.n_pieces), scene)) return false;
    rest = rest.subspan(list.n_pieces);
  }
  return true;
}

}  // namespace wrlkit::vrml
