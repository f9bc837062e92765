// A search tree of Embree, built on the threads of a runner.
#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::measure {

class EmbreeScene {
 public:
  /// Throws Failure kInternal.
  explicit EmbreeScene(RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);

  RTCDevice device() const { return device_.get(); }
  RTCScene get() const { return scene_.get(); }
  /// Takes the geometry, all that there will be, and builds the tree. Throws std::bad_alloc,
  /// Cancelled, Failure kInternal.
  void Build(RTCGeometry geometry, parallel::Runner& runner, const parallel::Progress& progress);

  // Around what a callback does in a thread of Embree: repeats, where the thread sanitizer sees it,
  // the order in which oneTBB hands the mesh to Embree's threads and back.
  static void TakeOver();
  static void HandOver();

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace folprom::measure
