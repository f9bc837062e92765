// An order along which the next vertex or face is looked for where nothing near it tells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/entropy/integer_model.h"
#include "engine/order/order_mesh.h"
#include "engine/order/unused_set.h"
#include "engine/order/work_space.h"

namespace folprom {

/// Scans are often written from one side to the other, slice by slice.
struct Sweep {
  std::span<const uint32_t> place_of;  ///< empty: the numbers themselves
  std::span<const uint32_t> sequence;  ///< the inverse
  bool from_first = false;  ///< counted from the first that is left; else from the one coded before

  uint32_t PlaceOf(uint32_t number) const { return place_of.empty() ? number : place_of[number]; }
  uint32_t At(uint32_t place) const { return sequence.empty() ? place : sequence[place]; }
};

/// How a sweep is named in a file: twice the key, one more where it counts from the first.
/// Vertices have the keys number, x, y, z; faces number, least and largest of the places of their
/// vertices; of a soup, number alone. Memory is taken from `space`, once for all sweeps that a
/// maker makes.
class SweepMaker {
 public:
  static constexpr uint32_t kVertexCodes = 8, kFaceCodes = 6, kSoupCodes = 2;

  /// Of vertices.
  SweepMaker(const OrderMesh& mesh, WorkSpace& space);
  /// Of faces, where the vertices have places; of a soup they have none yet.
  SweepMaker(const OrderMesh& mesh, std::span<const uint32_t> place_of, bool is_soup,
             WorkSpace& space);

  uint32_t codes() const { return codes_; }
  /// code < codes(). What was made before is lost.
  Sweep Make(uint32_t code);

 private:
  void SortVertices(uint32_t axis);
  void SortFaces(bool by_largest);
  /// bucket_of: below the number of counts_, and in the order of the sweep.
  template <class BucketOf, class Less>
  void Sort(BucketOf bucket_of, Less less);

  const OrderMesh& mesh_;
  std::span<const uint32_t> place_of_vertex_;
  const uint32_t codes_;
  WorkSpace& space_;
  std::span<uint32_t> place_of_, sequence_, counts_;
  uint32_t key_ = 0;
};

/// What is left of the vertices or faces, and a number that nothing near tells: how many that are
/// left lie between it and where the sweep counts from.
class Remaining {
 public:
  Remaining(uint32_t count, const Sweep& sweep) : sweep_(sweep), unused_(count) {}

  bool Has(uint32_t number) const { return unused_.Has(sweep_.PlaceOf(number)); }
  void Remove(uint32_t number) { unused_.Remove(sweep_.PlaceOf(number)); }
  /// The first that is left from this one on along the sweep; kNoNumber where there is none.
  uint32_t FirstFrom(uint32_t number) const {
    const uint32_t rank = unused_.Rank(sweep_.PlaceOf(number));
    return rank == unused_.left() ? kNoNumber : sweep_.At(unused_.Select(rank));
  }

  /// Codes one that is left; `last`: the one before. Throws Failure kCorrupt.
  template <class Coder>
  uint32_t Code(Coder& coder, uint32_t last, uint32_t number) {
    const uint32_t left = unused_.left();
    const uint32_t from = sweep_.from_first ? 0 : unused_.Rank(sweep_.PlaceOf(last));
    uint32_t distance = 0;
    if (Coder::kEncoding) distance = Folded(unused_.Rank(sweep_.PlaceOf(number)), from, left);
    distance = distances_.CodeUnsigned(coder, {0}, distance);
    if (distance >= left) throw Failure(ErrorKind::kCorrupt, "coded order goes beyond its end");
    return sweep_.At(unused_.Select(Unfolded(distance, from, left)));
  }

 private:
  /// Ranks 0 .. left - 1 as distances from `from` on: to both sides in turn, then to the longer.
  static uint32_t Folded(uint32_t rank, uint32_t from, uint32_t left) {
    const uint32_t both = std::min(from, left - from);
    if (rank >= from) return rank - from < both ? 2 * (rank - from) : rank;
    return from - rank <= both ? 2 * (from - rank) - 1 : left - 1 - rank;
  }
  static uint32_t Unfolded(uint32_t distance, uint32_t from, uint32_t left) {
    const uint32_t both = std::min(from, left - from);
    if (distance < 2 * both) {
      return distance % 2 == 0 ? from + distance / 2 : from - (distance + 1) / 2;
    }
    return from == both ? distance : left - 1 - distance;
  }

  Sweep sweep_;
  UnusedSet unused_;
  IntegerModel<1> distances_{{1}};
};

/// Encoder only: the code of the sweep along which the beginning of `numbers` takes the fewest
/// bytes.
uint32_t ChooseSweep(SweepMaker& maker, uint32_t count, std::span<const uint32_t> numbers);

}  // namespace folprom
