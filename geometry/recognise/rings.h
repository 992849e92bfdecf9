// Rings of a part: loops of equally many points with one band of faces between each two. A pipe run is a chain of them,
// and so are a box, a dish and an elbow.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/recognise/piece.h"

namespace wrlkit::recognising {

enum class ChainEnd : std::uint8_t { open, cap, apex, closed };

/// Columns run through all rings: point c of a ring is next to point c of the ones before and behind. Seen against the
/// direction from ring to ring (`facing` off: along it) the columns run anticlockwise where faces point outwards.
struct Chain {
  std::vector<std::vector<std::uint32_t>> rings;  // points; an apex is not a ring
  std::uint32_t first_apex = none, last_apex = none;
  ChainEnd first = ChainEnd::open, last = ChainEnd::open;
  std::vector<std::vector<std::uint32_t>> bands;       // faces between ring i and i + 1
  std::vector<std::uint32_t> first_faces, last_faces;  // of the caps, or around the apices
  std::uint32_t last_region = none;
};

/// Walks from ring to ring.
class RingWalk {
 public:
  explicit RingWalk(const Piece& piece) : p_(piece) {}

  /// Loops of half-edges around the part, in the order in which it is worth to start at them; faces that are already
  /// behind the loop, and whether they are a cap.
  struct Start {
    std::vector<std::uint32_t> loop;  // half-edges whose faces are in front
    ChainEnd end = ChainEnd::open;
    std::uint32_t region = none, apex = none;
    bool hollow = false;  // the region has other loops, too, and so has the one where the walk ends
  };
  std::vector<Start> starts() const;
  /// All loops around a planar region, each as half-edges whose faces are outside. None when a border is among them.
  std::vector<std::vector<std::uint32_t>> loops_around(std::uint32_t region) const;

  /// The chain from a start to where it ends; nothing when a band is not one.
  std::optional<Chain> walk(const Start& start) const;

 private:
  struct Band {
    std::vector<std::uint32_t> back;  // half-edges of the next ring, on this side of it, in the order of the columns
    std::vector<std::uint32_t> faces;
    std::uint32_t apex = none;
  };
  std::optional<Band> band(const std::vector<std::uint32_t>& loop) const;
  void align(const std::vector<std::uint32_t>& ring, std::vector<std::uint32_t>& back) const;
  bool is_cap(const std::vector<std::uint32_t>& loop, bool hollow, std::uint32_t& region) const;
  void take_region(std::uint32_t region, std::vector<std::uint32_t>& faces) const;
  void add_borders(std::vector<Start>& out) const;
  void add_regions(std::vector<Start>& out, std::uint32_t least, std::uint32_t most, std::size_t tries) const;
  void add_apices(std::vector<Start>& out) const;
  void add_straight_loops(std::vector<Start>& out) const;

  const Piece& p_;
};

}  // namespace wrlkit::recognising
