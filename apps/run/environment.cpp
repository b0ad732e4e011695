#include "apps/run/environment.h"

#include <fstream>
#include <thread>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <nlohmann/json.hpp>
#include <openssl/crypto.h>
#include <tbb/global_control.h>
#include <tbb/version.h>

#include "apps/run/build_id.h"
#include "sim/integrator.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

/// The widest that libraries with run-time dispatch (libm among them) choose by.
std::string instruction_set() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) return "avx512";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "avx2";
  if (__builtin_cpu_supports("avx")) return "avx";
  return "sse2";
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string libc() { return std::string("glibc ") + gnu_get_libc_version(); }

std::string quoted(const std::string& text) { return Json(text).dump(); }

}  // namespace

std::vector<ResolvedKey> simulation_build_keys() {
  const sim::LinearAlgebraInfo algebra = sim::linear_algebra_info();
  return {{"build.simulation", quoted(build_id.simulation)},
          {"build.cholmod", quoted(algebra.cholmod)},
          {"build.blas", quoted(algebra.blas)},
          {"build.blas_kernel", quoted(algebra.blas_kernel)},
          {"build.libc", quoted(libc())},
          {"build.instruction_set", quoted(instruction_set())}};
}

std::vector<ResolvedKey> picture_build_keys(const std::string& renderer) {
  return {{"build.program", quoted(build_id.program)}, {"build.renderer", quoted(renderer)}};
}

Json dependency_versions(const std::string& renderer) {
  const sim::LinearAlgebraInfo algebra = sim::linear_algebra_info();
  Json json = {
      {"cholmod", algebra.cholmod},
      {"blas", algebra.blas},
      {"blas_kernel", algebra.blas_kernel},
      {"blas_threads", algebra.blas_threads},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"tbb", TBB_runtime_version()},
      {"openssl", OpenSSL_version(OPENSSL_VERSION_STRING)},
      {"libc", libc()},
      {"compiler", __VERSION__}};
  if (!renderer.empty()) json["renderer"] = renderer;
  return json;
}

Json machine_description() {
  return {{"cpu", cpu_model()},
          {"cores", std::thread::hardware_concurrency()},
          {"threads", tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)},
          {"instruction_set", instruction_set()}};
}

}  // namespace lagomorph::apps
