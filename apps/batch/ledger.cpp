#include "apps/batch/ledger.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

constexpr auto kLockPatience = std::chrono::seconds(20);

// A name need not be valid UTF-8.
std::string LineOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// As it comes back from the file.
std::string Stored(const std::string& key) {
  return Json::parse(LineOf(Json(key))).get<std::string>();
}

Json FilesJson(const std::vector<KnownFile>& files) {
  Json json = Json::array();
  for (const KnownFile& file : files) {
    json.push_back({{"path", file.path},
                    {"size", file.stamp.size},
                    {"modified_ns", file.stamp.modified_ns},
                    {"changed_ns", file.stamp.changed_ns},
                    {"inode", file.stamp.inode},
                    {"hash", file.hash}});
  }
  return json;
}

std::vector<KnownFile> FilesOf(const Json& json) {
  std::vector<KnownFile> files;
  for (const Json& file : json) {
    files.push_back(
        {file.at("path"),
         {file.at("size"), file.at("modified_ns"), file.at("changed_ns"), file.at("inode")},
         file.at("hash")});
  }
  return files;
}

Json DoneLine(const std::string& key, const Record& record) {
  return {{"done", key}, {"record", ToJson(record)}};
}

Json BeginLine(const std::string& key, pid_t process) {
  return {{"begin", key}, {"process", process}};
}

bool IsAlive(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

}  // namespace

Json ToJson(const Record& record) {
  return {{"version", record.version},
          {"settings", record.settings},
          {"inputs", FilesJson(record.inputs)},
          {"outputs", FilesJson(record.outputs)},
          {"result", ToJson(record.result)}};
}

Result<Record> RecordFromJson(const Json& json) {
  try {
    return Record{json.at("version"), json.at("settings"), FilesOf(json.at("inputs")),
                  FilesOf(json.at("outputs")), OperationFromJson(json.at("result")).value()};
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const Json::exception& error) {
    return Error{ErrorKind::kInput, error.what()};
  }
}

Ledger::Ledger(const std::string& folder) : folder_(folder) { ReadLines(); }

void Ledger::ReadLines() {
  done_.clear();
  begun_.clear();
  std::error_code ignored;
  if (!fs::exists(PathOf(), ignored)) return;
  std::ifstream file(PathOf(), std::ios::binary);
  if (!file) throw Failure(ErrorKind::kInput, PathOf() + ": cannot be read");
  for (std::string text; std::getline(file, text);) {
    const Json line = Json::parse(text, nullptr, false);
    if (!line.is_object()) continue;
    if (line.contains("done") && line["done"].is_string() && line.contains("record")) {
      // Of another schema: its key is known, but it was not done.
      Result<Record> record = RecordFromJson(line["record"]);
      const auto key = line["done"].get<std::string>();
      begun_.insert_or_assign(key, 0);
      if (record) {
        done_.insert_or_assign(key, std::move(*record));
      }
    } else if (line.contains("begin") && line["begin"].is_string() &&
               line.value("process", Json()).is_number_integer()) {
      const auto key = line["begin"].get<std::string>();
      begun_.insert_or_assign(key, line["process"].get<pid_t>());
    }
  }
}

const Record* Ledger::Find(const std::string& key) const {
  const auto found = done_.find(Stored(key));
  return found == done_.end() ? nullptr : &found->second;
}

bool Ledger::Knows(const std::string& key) const { return begun_.contains(Stored(key)); }

void Ledger::RememberHashes(HashCache* cache) const {
  for (const auto& [key, record] : done_) {
    for (const KnownFile& file : record.inputs) cache->Remember(file);
    for (const KnownFile& file : record.outputs) cache->Remember(file);
  }
}

void Ledger::Open() {
  Lock();
  // Another batch may have written since.
  ReadLines();
  RemoveLeftovers();
  std::string text;
  for (const auto& [key, process] : begun_) {
    if (!done_.contains(key)) text += LineOf(BeginLine(key, 0));
  }
  for (const auto& [key, record] : done_) text += LineOf(DoneLine(key, record));
  // Not by an atomic file: one whose process is killed would stay under a name that nobody knows.
  const std::string fresh = PathOf() + ".new";
  {
    io::Descriptor file(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!file.open()) io::ThrowSystemError(ErrorKind::kOutput, fresh, "cannot open");
    io::WriteAll(file.get(), {reinterpret_cast<const uint8_t*>(text.data()), text.size()}, fresh);
    if (::fsync(file.get()) != 0) io::ThrowSystemError(ErrorKind::kOutput, fresh, "cannot sync");
    file.CloseChecked(fresh);
  }
  if (::rename(fresh.c_str(), PathOf().c_str()) != 0) {
    io::ThrowSystemError(ErrorKind::kOutput, PathOf(), "cannot rename into place");
  }
  file_ = io::Descriptor(::open(PathOf().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!file_.open()) io::ThrowSystemError(ErrorKind::kOutput, PathOf(), "cannot open");
}

// Processes of a batch that was killed hold the lock too, until they have cleaned up.
void Ledger::Lock() {
  lock_ = io::Descriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!lock_.open()) io::ThrowSystemError(ErrorKind::kOutput, folder_, "cannot open the folder");
  const auto end = std::chrono::steady_clock::now() + kLockPatience;
  while (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
    // A file system without locks: there is nothing to wait for.
    if (errno != EWOULDBLOCK && errno != EINTR) return;
    if (std::chrono::steady_clock::now() > end) {
      throw Failure(ErrorKind::kOutput, folder_ + ": another batch is at work in this folder");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void Ledger::RemoveLeftovers() const {
  std::set<std::string> killed;
  for (const auto& [key, process] : begun_) {
    if (process > 0 && !IsAlive(process))
      killed.insert(".folprom-" + std::to_string(process) + "-");
  }
  if (killed.empty()) return;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    const size_t end = name.rfind('-');
    if (name.ends_with(".tmp") && end != std::string::npos &&
        killed.contains(name.substr(0, end + 1))) {
      fs::remove(entry.path(), ignored);
    }
  }
}

void Ledger::Begin(const std::string& key, pid_t process) {
  Append(BeginLine(key, process));
  begun_.insert_or_assign(Stored(key), process);
}

void Ledger::Done(const std::string& key, const Record& record) {
  Append(DoneLine(key, record));
  begun_.insert_or_assign(Stored(key), 0);
  done_.insert_or_assign(Stored(key), record);
}

void Ledger::Append(const Json& json) {
  const std::string line = LineOf(json);
  io::WriteAll(file_.get(), {reinterpret_cast<const uint8_t*>(line.data()), line.size()}, PathOf());
}

}  // namespace folprom::batch
