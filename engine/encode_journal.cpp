#include "engine/encode_journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <variant>

#include "folprom/settings_keys.h"
#include "io/container/checksum.h"
#include "io/files/mapped_file.h"

namespace folprom {
namespace {

namespace fs = std::filesystem;

enum class RecordKind : uint8_t { kSubtree = 1, kSeam = 2 };

// Raised with every change of the records or of what lies beside them in the spill.
constexpr uint64_t kJournalVersion = 2;

uint64_t HashOf(std::span<const uint8_t> bytes) { return io::XxHash64(bytes); }
uint64_t HashOf(const std::string& text) {
  return HashOf({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// Size, time and a sample: a file that grew, was replaced or was edited is another one.
uint64_t HashScan(const std::string& path) {
  constexpr uint64_t kPieces = 64, kPieceBytes = 16384;
  const io::MappedFile file = io::MappedFile::Open(path).value();
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    io::ThrowSystemError(ErrorKind::kInput, path, "cannot read its status");
  }
  RecordWriter record;
  const auto bytes = file.bytes();
  record.Put(uint64_t{bytes.size()});
  record.Put(int64_t{status.st_mtim.tv_sec});
  record.Put(int64_t{status.st_mtim.tv_nsec});
  for (uint64_t i = 0; i < kPieces && !bytes.empty(); ++i) {
    const uint64_t begin = bytes.size() / kPieces * i;
    record.Put(HashOf(bytes.subspan(begin, std::min<uint64_t>(kPieceBytes, bytes.size() - begin))));
  }
  return HashOf(record.bytes());
}

uint64_t HashSettings(const EncodeOptions& options) {
  RecordWriter record;
  for (const SettingKey& key : SettingKeys()) {
    std::visit([&](auto member) { record.Put(options.codec.*member); }, key.member);
  }
  record.Put(options.bits);
  record.Put(options.tolerance);
  record.Put(options.exact);
  record.Put(options.attributes);
  record.Put(options.weld);
  for (const std::string& bits : options.attribute_bits) {
    for (const char c : bits) record.Put(c);
    record.Put('\n');
  }
  return HashOf(record.bytes());
}

// With the file of the program itself: one that was built anew may code otherwise.
uint64_t HashProgram() {
  RecordWriter record;
  struct stat status {};
  if (::stat("/proc/self/exe", &status) == 0) {
    record.Put(int64_t{status.st_size});
    record.Put(int64_t{status.st_mtim.tv_sec});
    record.Put(int64_t{status.st_mtim.tv_nsec});
  }
  record.Put(HashOf(std::string(FOLPROM_VERSION)));
  record.Put(io::kFormatVersion);
  record.Put(kJournalVersion);
  return HashOf(record.bytes());
}

// The payload of the record at the front of *bytes, which is cut off; none where it is not whole.
std::optional<std::span<const uint8_t>> TakeRecord(std::span<const uint8_t>* bytes) {
  constexpr size_t kHead = 2 * sizeof(uint64_t);
  if (bytes->size() < kHead) return std::nullopt;
  RecordReader head(bytes->first(kHead));
  const auto size = head.Take<uint64_t>(), hash = head.Take<uint64_t>();
  if (size > bytes->size() - kHead) return std::nullopt;
  const auto payload = bytes->subspan(kHead, size);
  if (HashOf(payload) != hash) return std::nullopt;
  *bytes = bytes->subspan(kHead + size);
  return payload;
}

const char* DifferenceOf(const JobIdentity& left, const JobIdentity& now) {
  if (left.program != now.program) return "another version of the program left them";
  if (left.scan != now.scan) return "the scan has changed";
  if (left.settings != now.settings) return "the settings have changed";
  return nullptr;
}

JobIdentity ReadIdentity(RecordReader* record) {
  JobIdentity identity;
  record->Take(&identity.scan);
  record->Take(&identity.settings);
  record->Take(&identity.program);
  return identity;
}

// False where the record is of no subtree of this partition.
bool AddRecord(std::span<const uint8_t> payload, DoneWork* work) {
  RecordReader record(payload);
  const auto kind = record.Take<RecordKind>();
  const auto subtree = record.Take<uint32_t>();
  if (subtree >= work->partition.summaries.size()) return false;
  if (kind == RecordKind::kSubtree) {
    Read(&record, &work->subtrees[subtree]);
  } else {
    Read(&record, &work->seams[subtree]);
  }
  return true;
}

template <class Outcome>
RecordWriter RecordOf(RecordKind kind, uint32_t subtree, const Outcome& outcome) {
  RecordWriter record;
  record.Put(kind);
  record.Put(subtree);
  Write(outcome, &record);
  return record;
}

}  // namespace

JobIdentity IdentityOf(const std::string& input, const EncodeOptions& options) {
  return {HashScan(input), HashSettings(options), HashProgram()};
}

std::string SpillName(const std::string& input, const std::string& output) {
  const std::string key = std::to_string(::geteuid()) + '\n' +
                          fs::weakly_canonical(fs::absolute(input)).string() + '\n' +
                          fs::weakly_canonical(fs::absolute(output)).string();
  char text[32];
  std::snprintf(text, sizeof text, "encode-%016llx", static_cast<unsigned long long>(HashOf(key)));
  return text;
}

EncodeJournal::EncodeJournal(const io::SpillDirectory& spill) : path_(spill.File("journal")) {}

std::optional<DoneWork> EncodeJournal::Recover(const JobIdentity& identity, std::string* why) {
  auto journal = io::MappedFile::Open(path_);
  if (!journal) return std::nullopt;
  auto left = journal.value().bytes();
  const auto first = TakeRecord(&left);
  if (!first) {
    *why = "their journal is damaged";
    return std::nullopt;
  }
  try {
    RecordReader record(*first);
    if (const char* difference = DifferenceOf(ReadIdentity(&record), identity)) {
      *why = difference;
      return std::nullopt;
    }
    DoneWork work;
    Read(&record, &work.partition);
    auto whole = left;
    while (const auto payload = TakeRecord(&left)) {
      if (!AddRecord(*payload, &work)) break;
      whole = left;
    }
    file_ = io::Descriptor(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    const auto end = static_cast<off_t>(journal.value().bytes().size() - whole.size());
    if (!file_.open() || ::ftruncate(file_.get(), end) != 0) {
      io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot write temporary file");
    }
    return work;
  } catch (const Failure& failure) {
    *why = failure.error().message;
    return std::nullopt;
  }
}

void EncodeJournal::Begin(const JobIdentity& identity, const PartitionState& state) {
  RecordWriter record;
  record.Put(identity.scan);
  record.Put(identity.settings);
  record.Put(identity.program);
  Write(state, &record);
  file_ = io::Descriptor(
      ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0600));
  if (!file_.open()) io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot open temporary file");
  Append(record);
}

void EncodeJournal::Add(uint32_t subtree, const SubtreeOutcome& outcome) {
  Append(RecordOf(RecordKind::kSubtree, subtree, outcome));
}

void EncodeJournal::Add(uint32_t owner, const SeamOutcome& outcome) {
  Append(RecordOf(RecordKind::kSeam, owner, outcome));
}

void EncodeJournal::Append(const RecordWriter& record) {
  RecordWriter head;
  head.Put(uint64_t{record.bytes().size()});
  head.Put(HashOf(record.bytes()));
  std::vector<uint8_t> bytes = head.bytes();
  bytes.insert(bytes.end(), record.bytes().begin(), record.bytes().end());
  const std::lock_guard lock(mutex_);
  io::WriteAll(file_.get(), bytes, path_);
}

}  // namespace folprom
