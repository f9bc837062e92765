#include "engine/codec/border_seam_truth.h"

#include <algorithm>
#include <utility>

#include "folprom/result.h"

namespace folprom {
namespace {

/// Finds the oracle's vertex of an original border vertex.
class VertexFinder {
 public:
  explicit VertexFinder(const std::vector<SeamMember>& members) {
    uint32_t offset = 0;
    for (const SeamMember& member : members) {
      Part part{member.subtree, {}};
      for (uint32_t b = 0; b < member.original_of_border.size(); ++b) {
        part.entries.push_back({member.original_of_border[b], offset + b});
      }
      std::sort(part.entries.begin(), part.entries.end());
      offset += static_cast<uint32_t>(member.original_of_border.size());
      parts_.push_back(std::move(part));
    }
  }
  /// Index of the member, parts_.size() when the subtree takes no part.
  size_t MemberOf(uint32_t subtree) const {
    size_t i = 0;
    while (i < parts_.size() && parts_[i].subtree != subtree) ++i;
    return i;
  }
  uint32_t Find(size_t member, uint32_t local) const {
    const auto& entries = parts_[member].entries;
    auto it =
        std::lower_bound(entries.begin(), entries.end(), std::pair<uint32_t, uint32_t>{local, 0});
    if (it == entries.end() || it->first != local) {
      throw Failure(ErrorKind::kInternal, "a cross face names a vertex that is no border vertex");
    }
    return it->second;
  }

 private:
  struct Part {
    uint32_t subtree;
    std::vector<std::pair<uint32_t, uint32_t>> entries;
  };
  std::vector<Part> parts_;
};

}  // namespace

BorderSeamTruth::Input BorderSeamTruth::Collect(const std::vector<SeamMember>& members,
                                                std::span<const CrossFace> cross_faces) {
  Input input;
  VertexFinder finder(members);
  for (uint32_t m = 0; m < members.size(); ++m) {
    uint32_t count = static_cast<uint32_t>(members[m].original_of_border.size());
    input.participant_of_vertex.insert(input.participant_of_vertex.end(), count, m);
    input.vertices += count;
  }
  uint32_t owner = members.back().subtree;
  std::vector<Face> edges_only;
  for (const CrossFace& face : cross_faces) {
    size_t member[3];
    bool all_here = true;
    for (size_t i = 0; i < 3; ++i) {
      member[i] = face.vertex[i].subtree <= owner ? finder.MemberOf(face.vertex[i].subtree)
                                                  : members.size();
      all_here &= member[i] < members.size();
    }
    auto vertex = [&](size_t i) { return finder.Find(member[i], face.vertex[i].local); };
    if (all_here) {
      input.triples.push_back({vertex(0), vertex(1), vertex(2)});
      const Face of_face{static_cast<uint32_t>(member[0]), static_cast<uint32_t>(member[1]),
                         static_cast<uint32_t>(member[2])};
      Face sorted = of_face;
      std::sort(sorted.begin(), sorted.end());
      if (sorted[0] != sorted[1] && sorted[1] != sorted[2]) {
        input.root_faces.push_back({sorted[0], sorted[1], RunsAlong(sorted, of_face)});
      }
      continue;
    }
    // The face belongs to a higher seam; its edge between the owner and a lower subtree is ours.
    for (size_t i = 0; i < 3; ++i) {
      size_t j = (i + 1) % 3;
      if (member[i] >= members.size() || member[j] >= members.size() || member[i] == member[j]) {
        continue;
      }
      edges_only.push_back({vertex(i), vertex(j), vertex(j)});
    }
  }
  input.real_faces = input.triples.size();
  input.triples.insert(input.triples.end(), edges_only.begin(), edges_only.end());
  std::sort(input.root_faces.begin(), input.root_faces.end());
  return input;
}

BorderSeamTruth::BorderSeamTruth(const std::vector<SeamMember>& members,
                                 std::span<const CrossFace> cross_faces)
    : BorderSeamTruth(members, Collect(members, cross_faces)) {}

BorderSeamTruth::BorderSeamTruth(const std::vector<SeamMember>& members, Input input)
    : real_faces_(input.real_faces),
      root_faces_(std::move(input.root_faces)),
      oracle_(input.vertices, std::move(input.triples), std::move(input.participant_of_vertex)) {
  uint32_t offset = 0;
  for (const SeamMember& member : members) {
    replays_.push_back(PlanReplay(*member.border, offset));
    borders_.push_back(member.border);
    offset += static_cast<uint32_t>(member.original_of_border.size());
  }
}

BorderSeamTruth::Replay BorderSeamTruth::PlanReplay(const BorderRecord& border, uint32_t offset) {
  // Backwards the sets merge, which gives each event the size of its second child.
  Replay replay;
  replay.second_size.assign(border.events.size(), 0);
  uint32_t sets = 1;
  for (const BorderEvent& event : border.events) sets += event.both;
  std::vector<uint32_t> size(sets, 1);
  uint32_t last = sets;
  for (size_t e = border.events.size(); e-- > 0;) {
    const BorderEvent& event = border.events[e];
    if (event.both == 0) continue;
    --last;
    replay.second_size[e] = size[last];
    size[event.border] += size[last];
  }
  // Forwards the ranges part; in the end each set is one vertex.
  replay.begin.assign(1, 0);
  replay.end.assign(1, sets);
  for (size_t e = 0; e < border.events.size(); ++e) {
    const BorderEvent& event = border.events[e];
    if (event.both == 0) continue;
    uint32_t end = replay.end[event.border];
    replay.end[event.border] = end - replay.second_size[e];
    replay.begin.push_back(end - replay.second_size[e]);
    replay.end.push_back(end);
  }
  replay.leaves.resize(sets);
  for (uint32_t b = 0; b < sets; ++b) replay.leaves[replay.begin[b]] = offset + b;
  replay.begin.assign(1, 0);
  replay.end.assign(1, sets);
  return replay;
}

std::span<const BorderSeamTruth::RootFace> BorderSeamTruth::RootFaces(uint32_t a,
                                                                      uint32_t b) const {
  const auto begin =
      std::lower_bound(root_faces_.begin(), root_faces_.end(), RootFace{a, b, false});
  return {begin, std::upper_bound(begin, root_faces_.end(), RootFace{a, b, true})};
}

bool BorderSeamTruth::RootFaceForward(uint32_t a, uint32_t b) const {
  const auto faces = RootFaces(a, b);
  const auto forward =
      std::count_if(faces.begin(), faces.end(), [](const RootFace& face) { return face.forward; });
  return 2 * static_cast<size_t>(forward) >= faces.size();
}

void BorderSeamTruth::BeginSplit(uint32_t participant, uint32_t event, uint32_t vertex) {
  Replay& replay = replays_[participant];
  uint32_t border = borders_[participant]->events[event].border;
  uint32_t begin = replay.begin[border], end = replay.end[border];
  uint32_t middle = end - replay.second_size[event];
  replay.end[border] = middle;
  replay.begin.push_back(middle);
  replay.end.push_back(end);
  bool second_is_smaller = end - middle <= middle - begin;
  std::span<const uint32_t> leaves(replay.leaves);
  std::span<const uint32_t> moved = second_is_smaller ? leaves.subspan(middle, end - middle)
                                                      : leaves.subspan(begin, middle - begin);
  oracle_.Scan(vertex, std::span(&moved, 1), second_is_smaller);
}

FaceCensus BorderSeamTruth::CountFaces(const Complex& complex) const {
  return TakeCensus(complex, oracle_, real_faces_);
}

}  // namespace folprom
