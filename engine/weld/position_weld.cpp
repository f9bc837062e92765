#include "engine/weld/position_weld.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/mapped_space.h"
#include "engine/partition/block_pool.h"
#include "engine/weld/packed_position.h"
#include "io/container/checksum.h"

namespace folprom {
namespace {

/// Of the table that finds equal positions, for each different one, while it grows.
constexpr uint64_t kTableBytes = 96;
constexpr uint64_t kMostBuckets = 4096;
constexpr uint64_t kBufferBytes = 64 << 10;
/// Records after which the pages of a file that is read to its end may go.
constexpr size_t kRecordsBetweenDrops = size_t{1} << 20;
/// Vertices whose numbers are looked up at random between two looks at the memory.
constexpr size_t kLookups = 1024;

uint64_t HashOf(std::span<const uint32_t> words) {
  return io::XxHash64({reinterpret_cast<const uint8_t*>(words.data()), words.size_bytes()});
}

/// A power of two.
uint64_t BucketsFor(uint64_t vertices, uint64_t memory_bytes) {
  const uint64_t each = std::max<uint64_t>(memory_bytes / 4 / kTableBytes, 1);
  return std::bit_ceil(std::clamp<uint64_t>(vertices / each + 1, 1, kMostBuckets));
}

/// Numbers positions in the order in which they come first.
class DistinctPositions {
 public:
  explicit DistinctPositions(size_t words) : words_(words), slots_(1024, kEmpty) {}

  uint32_t NumberOf(std::span<const uint32_t> position) {
    const size_t slot = SlotOf(position);
    if (slots_[slot] != kEmpty) return slots_[slot];
    const uint32_t number = count_++;
    if (number == kEmpty) throw Failure(ErrorKind::kLimit, "too many vertices to be welded");
    slots_[slot] = number;
    all_.insert(all_.end(), position.begin(), position.end());
    if (2 * size_t{count_} > slots_.size()) Grow();
    return number;
  }
  uint32_t count() const { return count_; }

 private:
  static constexpr uint32_t kEmpty = 0xffffffffu;

  std::span<const uint32_t> At(uint32_t number) const {
    return std::span(all_).subspan(size_t{number} * words_, words_);
  }
  /// Where the position is, or is to be. The upper bits of the hash name the bucket.
  size_t SlotOf(std::span<const uint32_t> position) const {
    const size_t mask = slots_.size() - 1;
    size_t slot = HashOf(position) & mask;
    while (slots_[slot] != kEmpty && !std::ranges::equal(At(slots_[slot]), position)) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }
  void Grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (uint32_t number = 0; number < count_; ++number) slots_[SlotOf(At(number))] = number;
  }

  size_t words_;
  std::vector<uint32_t> slots_, all_;
  uint32_t count_ = 0;
};

/// A block of the scan on its way to the buckets, or back.
struct WeldBlock {
  std::vector<double> xyz;
  std::vector<uint32_t> words, buckets;
};

class Welder {
 public:
  Welder(const io::MeshSource& source, uint64_t memory_bytes, const io::SpillDirectory& spill,
         parallel::Runner& runner, parallel::Progress& progress)
      : source_(source),
        packed_(source.coordinate_type()),
        words_(packed_.words()),
        buckets_(BucketsFor(source.vertex_count(), memory_bytes)),
        shift_(64 - std::countr_zero(buckets_)),
        runner_(runner),
        progress_(progress),
        spill_(spill),
        space_(spill, kTableName, memory_bytes),
        keys_(spill, kKeysName, buckets_, std::min(memory_bytes / 16, buckets_ * kBufferBytes)),
        locals_(spill, kLocalsName, buckets_, kBufferBytes),
        out_(spill, "weld", 2, uint64_t{1} << 20) {}

  PositionWeld Weld() {
    progress_.StartStage("weld", 3 * source_.vertex_count());
    DealOut();
    FindEqual();
    GiveNumbers();
    PositionWeld weld;
    weld.count = count_;
    weld.numbers = out_.Map(0);
    weld.positions = out_.Map(1);
    weld.peak_spill_bytes = spill_.SizeBytes();
    RemoveScratch();
    return weld;
  }

 private:
  static constexpr const char *kTableName = "numbers", *kKeysName = "keys", *kLocalsName = "locals";

  /// What only the passes need. A file that is mapped goes with its mapping.
  void RemoveScratch() const {
    std::error_code ignored;  // the whole folder goes later
    std::filesystem::remove(spill_.File(std::string(kTableName) + ".0"), ignored);
    for (size_t bucket = 0; bucket < buckets_; ++bucket) {
      for (const char* name : {kKeysName, kLocalsName}) {
        std::filesystem::remove(spill_.File(std::string(name) + "." + std::to_string(bucket)),
                                ignored);
      }
    }
  }

  /// Calls work(block of the pool) for each block of the scan in its order.
  template <class Work>
  void ForEachBlock(Work work) {
    const auto produce = [&](size_t index) {
      WeldBlock& block = pool_.Begin(index);
      source_.ReadVertexBlock(index, &block.xyz).value();
      const size_t count = block.xyz.size() / 3;
      block.words.resize(count * words_);
      block.buckets.resize(count);
      for (size_t i = 0; i < count; ++i) {
        uint32_t* words = &block.words[i * words_];
        packed_.Pack(&block.xyz[3 * i], words);
        block.buckets[i] =
            buckets_ == 1 ? 0 : static_cast<uint32_t>(HashOf({words, words_}) >> shift_);
      }
    };
    const auto consume = [&](size_t index) {
      WeldBlock& block = pool_.At(index);
      work(block);
      progress_.Advance(block.buckets.size());
      pool_.End(index);
      if (index % 16 == 15) source_.DropResident();
    };
    const size_t window = 2 * static_cast<size_t>(runner_.threads()) + 2;
    runner_.Ordered(source_.vertex_block_count(), window, produce, consume);
    source_.DropResident();
  }

  void DealOut() {
    ForEachBlock([&](const WeldBlock& block) {
      for (size_t i = 0; i < block.buckets.size(); ++i) {
        keys_.Append(block.buckets[i], &block.words[i * words_], words_ * sizeof(uint32_t));
      }
    });
    keys_.Finish();
  }

  /// Leaves, for each position of a bucket, its number there.
  void FindEqual() {
    for (size_t bucket = 0; bucket < buckets_; ++bucket) {
      progress_.ThrowIfCancelled();
      const io::MappedFile file = keys_.Map(bucket);
      const auto words = io::MappedArray<uint32_t>(file);
      DistinctPositions distinct(words_);
      const size_t records = words.size() / words_;
      for (size_t i = 0; i < records; ++i) {
        locals_.AppendValue(bucket, distinct.NumberOf(words.subspan(i * words_, words_)));
        if (i % kRecordsBetweenDrops != kRecordsBetweenDrops - 1) continue;
        file.DropResident();
        progress_.ThrowIfCancelled();
      }
      first_.push_back(count_);
      count_ += distinct.count();
      progress_.Advance(records);
    }
    locals_.Finish();
  }

  /// From the numbers inside the buckets those in the whole scan.
  void GiveNumbers() {
    // Two words each; the file of a mapping begins at a page.
    const std::span<uint32_t> table = space_.Words(2 * count_);
    const std::span<uint64_t> numbers{reinterpret_cast<uint64_t*>(table.data()), count_};
    std::vector<std::span<const uint32_t>> locals;
    for (size_t bucket = 0; bucket < buckets_; ++bucket) {
      const auto bytes = space_.Adopt(locals_.Map(bucket));
      locals.push_back({reinterpret_cast<const uint32_t*>(bytes.data()), bytes.size() / 4});
    }
    std::vector<size_t> at(buckets_, 0);
    std::vector<uint32_t> seen(buckets_, 0);
    uint64_t next = 0;
    ForEachBlock([&](const WeldBlock& block) {
      for (size_t i = 0; i < block.buckets.size(); ++i) {
        const uint32_t bucket = block.buckets[i];
        const uint32_t local = locals[bucket][at[bucket]++];
        uint64_t& number = numbers[first_[bucket] + local];
        if (local == seen[bucket]) {
          ++seen[bucket];
          number = next++;
          out_.Append(1, &block.words[i * words_], words_ * sizeof(uint32_t));
        }
        out_.AppendValue(0, number);
        if (i % kLookups == 0) space_.Stepped(kLookups);
      }
    });
    out_.Finish();
  }

  const io::MeshSource& source_;
  const PackedPosition packed_;
  const size_t words_;
  const size_t buckets_;
  const int shift_;  ///< of the hash; its upper bits name the bucket
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  const io::SpillDirectory& spill_;
  MappedSpace space_;
  io::SpillStreams keys_, locals_;
  io::SpillStreams out_;  ///< 0: numbers, 1: positions
  partition::BlockPool<WeldBlock> pool_;
  std::vector<uint64_t> first_;  ///< of the different positions of each bucket, in the table
  uint64_t count_ = 0;
};

}  // namespace

PositionWeld WeldPositions(const io::MeshSource& source, uint64_t memory_bytes,
                           const io::SpillDirectory& spill, parallel::Runner& runner,
                           parallel::Progress& progress) {
  return Welder(source, memory_bytes, spill, runner, progress).Weld();
}

uint64_t WeldSpillBytes(const io::MeshSource& source) {
  const uint64_t position = PackedPosition(source.coordinate_type()).words() * sizeof(uint32_t);
  // The position twice, its number in the bucket and in the scan, and the table of the latter.
  return source.vertex_count() * (2 * position + sizeof(uint32_t) + 2 * sizeof(uint64_t));
}

}  // namespace folprom
