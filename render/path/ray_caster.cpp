#include "render/path/ray_caster.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include "render/error.h"

namespace lagomorph::render::path {
namespace {

/// Embree's calls for packets of N rays.
template <int N>
struct Packet;
template <>
struct Packet<4> {
  using RayHits = RTCRayHit4;
  using Rays = RTCRay4;
  static constexpr auto intersect = rtcIntersect4;
  static constexpr auto occluded = rtcOccluded4;
};
template <>
struct Packet<8> {
  using RayHits = RTCRayHit8;
  using Rays = RTCRay8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Packet<16> {
  using RayHits = RTCRayHit16;
  using Rays = RTCRay16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occluded = rtcOccluded16;
};

RTCIntersectContext context(Coherence coherence) {
  RTCIntersectContext c;
  rtcInitIntersectContext(&c);
  c.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                             : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return c;
}

/// Lane k of a packet becomes the ray; lanes past the last ray repeat it and are masked out.
template <int N>
void load(typename Packet<N>::Rays& packet, int k, const Ray& ray) {
  packet.org_x[k] = ray.origin.x();
  packet.org_y[k] = ray.origin.y();
  packet.org_z[k] = ray.origin.z();
  packet.tnear[k] = 0.0F;
  packet.dir_x[k] = ray.direction.x();
  packet.dir_y[k] = ray.direction.y();
  packet.dir_z[k] = ray.direction.z();
  packet.time[k] = ray.time;
  packet.mask[k] = 0xffffffffU;
  packet.id[k] = 0;
  packet.flags[k] = 0;
}

/// The same of rows, from `first` on: rows are as long as whole packets, and what is behind the last ray is
/// masked out.
template <int N>
void load(typename Packet<N>::Rays& packet, const RayRows& rays, std::size_t first) {
  const auto copy = [first](float* to, const Row<float>& row) {
    std::memcpy(to, row.data() + first, N * sizeof(float));
  };
  copy(packet.org_x, rays.origin.x);
  copy(packet.org_y, rays.origin.y);
  copy(packet.org_z, rays.origin.z);
  copy(packet.dir_x, rays.direction.x);
  copy(packet.dir_y, rays.direction.y);
  copy(packet.dir_z, rays.direction.z);
  copy(packet.time, rays.time);
  for (int k = 0; k < N; ++k) {
    packet.tnear[k] = 0.0F;
    packet.mask[k] = 0xffffffffU;
    packet.id[k] = 0;
    packet.flags[k] = 0;
  }
}

/// Closest hits of `count` rays; `fill` puts those from a number on into a packet.
template <int N, class Fill>
void intersect_packets(RTCScene scene, std::size_t count, const Fill& fill, Coherence coherence,
                       std::span<MeshHit> hits) {
  RTCIntersectContext c = context(coherence);
  typename Packet<N>::RayHits packet;
  alignas(64) int valid[N];
  for (std::size_t first = 0; first < count; first += N) {
    const std::size_t in_packet = std::min<std::size_t>(N, count - first);
    fill(packet.ray, first, in_packet);
    for (int k = 0; k < N; ++k) {
      packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
      valid[k] = static_cast<std::size_t>(k) < in_packet ? -1 : 0;
    }
    Packet<N>::intersect(valid, scene, &c, &packet);
    for (std::size_t k = 0; k < in_packet; ++k)
      hits[first + k] = {packet.hit.geomID[k], packet.hit.primID[k]};
  }
}

template <int N>
void intersect_rows(RTCScene scene, const RayRows& rays, Coherence coherence, std::span<MeshHit> hits) {
  const auto fill = [&](typename Packet<N>::Rays& packet, std::size_t first, std::size_t) {
    load<N>(packet, rays, first);
  };
  intersect_packets<N>(scene, rays.count, fill, coherence, hits);
}

template <int N>
void intersect_rays(RTCScene scene, std::span<const Ray> rays, Coherence coherence, std::span<MeshHit> hits) {
  const auto fill = [&](typename Packet<N>::Rays& packet, std::size_t first, std::size_t count) {
    for (int k = 0; k < N; ++k)
      load<N>(packet, k, rays[first + std::min(static_cast<std::size_t>(k), count - 1)]);
  };
  intersect_packets<N>(scene, rays.size(), fill, coherence, hits);
}

template <int N>
void occluded_rows(RTCScene scene, const RayRows& rays, Coherence coherence,
                   std::span<std::uint8_t> blocked) {
  RTCIntersectContext c = context(coherence);
  typename Packet<N>::Rays packet;
  alignas(64) int valid[N];
  for (std::size_t first = 0; first < rays.count; first += N) {
    const std::size_t count = std::min<std::size_t>(N, rays.count - first);
    load<N>(packet, rays, first);
    std::memcpy(packet.tfar, rays.far.data() + first, N * sizeof(float));
    for (int k = 0; k < N; ++k) valid[k] = static_cast<std::size_t>(k) < count ? -1 : 0;
    Packet<N>::occluded(valid, scene, &c, &packet);
    for (std::size_t k = 0; k < count; ++k) blocked[first + k] = packet.tfar[k] < 0.0F ? 1 : 0;
  }
}

/// Calls `of` with the width of the packets as a constant.
template <class Of>
void with_width(int width, const Of& of) {
  switch (width) {
    case 16:
      return of(std::integral_constant<int, 16>{});
    case 8:
      return of(std::integral_constant<int, 8>{});
    default:
      return of(std::integral_constant<int, 4>{});
  }
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RTCGeometry> geometries;  // a mesh each, owned by the scene; null without triangles
  int packet_width = 4;
  unsigned segments = 0;  // of motion; time steps are one more, the frame's last

  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void set_positions(int mesh, unsigned step, std::span<const Vec3> positions) const {
    RTCGeometry geometry = geometries[static_cast<std::size_t>(mesh)];
    if (geometry == nullptr) return;
    std::copy(positions.begin(), positions.end(),
              static_cast<Vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, step)));
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step);
    rtcCommitGeometry(geometry);
  }

  void check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw DeviceError(std::string("Embree cannot ") + what +
                      (error == RTC_ERROR_OUT_OF_MEMORY
                           ? ": out of memory"
                           : ": error " + std::to_string(static_cast<int>(error))));
  }
};

RayCaster::RayCaster() : impl_(std::make_unique<Impl>()) {
  // Not "threads=": that would limit TBB in the whole process. Builds run where they are called, in an arena.
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) {
    throw DeviceError("Embree gives no device: error " +
                      std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))));
  }
  if (rtcGetDeviceProperty(impl_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0)
    impl_->packet_width = 8;
  if (rtcGetDeviceProperty(impl_->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0)
    impl_->packet_width = 16;
}

RayCaster::~RayCaster() = default;

void RayCaster::build(std::span<const Mesh> meshes, int segments) {
  impl_->segments = static_cast<unsigned>(segments);
  if (impl_->scene != nullptr) rtcReleaseScene(impl_->scene);
  impl_->geometries.clear();
  impl_->scene = rtcNewScene(impl_->device);
  // Embree refits a geometry of quality REFIT only in a scene of quality LOW; in others it rebuilds it
  // silently.
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_LOW);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
  for (const Mesh& mesh : meshes) {
    if (mesh.triangles.empty()) {
      impl_->geometries.push_back(nullptr);
      continue;
    }
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    if (segments > 0) rtcSetGeometryTimeStepCount(geometry, impl_->segments + 1);
    void* positions = nullptr;
    for (unsigned step = 0; step <= impl_->segments; ++step) {
      positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                          sizeof(Vec3), mesh.positions.size());
      if (positions != nullptr)
        std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(positions));
    }
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    if (positions != nullptr && triangles != nullptr) {
      std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(impl_->scene, geometry, static_cast<unsigned>(impl_->geometries.size()));
    }
    impl_->geometries.push_back(geometry);
    rtcReleaseGeometry(geometry);
    impl_->check("hold the meshes");
  }
  commit();
}

void RayCaster::move(int mesh, std::span<const Vec3> positions) {
  impl_->set_positions(mesh, impl_->segments, positions);
}

void RayCaster::move_at(int step, int mesh, std::span<const Vec3> positions) {
  impl_->set_positions(mesh, static_cast<unsigned>(step), positions);
}

void RayCaster::commit() {
  if (impl_->segments > 0) {
    // Embree refits nothing that moves. One thread makes the same hierarchy whatever the number of threads.
    tbb::task_arena alone(1);
    alone.execute([&] { rtcCommitScene(impl_->scene); });
  } else {
    rtcCommitScene(impl_->scene);
  }
  impl_->check("build the ray tracing hierarchy");
}

void RayCaster::intersect(std::span<const Ray> rays, Coherence coherence, std::span<MeshHit> hits) const {
  with_width(impl_->packet_width, [&](auto width) {
    intersect_rays<decltype(width)::value>(impl_->scene, rays, coherence, hits);
  });
}

void RayCaster::intersect(const RayRows& rays, Coherence coherence, std::span<MeshHit> hits) const {
  with_width(impl_->packet_width, [&](auto width) {
    intersect_rows<decltype(width)::value>(impl_->scene, rays, coherence, hits);
  });
}

void RayCaster::occluded(const RayRows& rays, Coherence coherence, std::span<std::uint8_t> blocked) const {
  with_width(impl_->packet_width, [&](auto width) {
    occluded_rows<decltype(width)::value>(impl_->scene, rays, coherence, blocked);
  });
}

std::string RayCaster::description() const {
  const auto version = rtcGetDeviceProperty(impl_->device, RTC_DEVICE_PROPERTY_VERSION);
  const char* isa = impl_->packet_width == 16                                                   ? "avx512"
                    : impl_->packet_width == 4                                                  ? "sse"
                    : __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 ? "avx2"
                                                                                                : "avx";
  return "Embree " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100) + " isa=" + isa;
}

}  // namespace lagomorph::render::path
