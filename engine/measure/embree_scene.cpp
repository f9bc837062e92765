#include "engine/measure/embree_scene.h"

#include <atomic>
#include <cstdint>
#include <new>
#include <string>

#include "folprom/result.h"

namespace folprom::measure {
namespace {

#if defined(__SANITIZE_THREAD__)
std::atomic<uint32_t> order_of_handover{0};
#endif

// Embree asks while it builds.
bool GoesOn(void* progress, double) {
  try {
    static_cast<const parallel::Progress*>(progress)->ThrowIfCancelled();
  } catch (const parallel::Cancelled&) {
    return false;
  }
  return true;
}

}  // namespace

#if defined(__SANITIZE_THREAD__)
void EmbreeScene::HandOver() { order_of_handover.fetch_add(1, std::memory_order_release); }
void EmbreeScene::TakeOver() {
  static_cast<void>(order_of_handover.load(std::memory_order_acquire));
}
#else
void EmbreeScene::HandOver() {}
void EmbreeScene::TakeOver() {}
#endif

EmbreeScene::EmbreeScene(RTCSceneFlags flags) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw Failure(ErrorKind::kInternal, "Embree does not start");
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), flags);
}

void EmbreeScene::Build(RTCGeometry geometry, parallel::Runner& runner,
                        const parallel::Progress& progress) {
  auto* watched = const_cast<parallel::Progress*>(&progress);  // Embree hands on a void*.
  rtcSetSceneProgressMonitorFunction(scene_.get(), &GoesOn, watched);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  // Embree works with oneTBB, in the arena of its caller: inside a task, that of the runner. A
  // number of threads given to Embree itself would bind the whole process.
  HandOver();
  runner.ForEach(1, [&](size_t) { rtcCommitScene(scene_.get()); });
  TakeOver();
  progress.ThrowIfCancelled();
  const RTCError error = rtcGetDeviceError(device_.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) {
    throw Failure(ErrorKind::kInternal, "Embree fails with error " + std::to_string(error));
  }
}

}  // namespace folprom::measure
