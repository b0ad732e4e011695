#include "tests/bench/forward_frame.h"

#include "render/raster/light_view.h"

namespace lagomorph::bench {
namespace {

using namespace render;
using namespace render::raster;

constexpr const char* mesh_vertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 x, n;
void main() {
  x = position;
  n = normal;
  gl_Position = clip_from_world * vec4(x, 1.0);
}
)";

constexpr const char* ground_vertex = R"(
uniform mat4 clip_from_world;
uniform float height, radius;
out vec3 x, n;
void main() {
  vec2 at = radius * (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0);
  x = vec3(at.x, height, at.y);
  n = vec3(0.0, 1.0, 0.0);
  gl_Position = clip_from_world * vec4(x, 1.0);
}
)";

// Walter et al. 2007's GGX with Schlick's Fresnel term, and percentage closer filtering on a spiral of
// places.
constexpr const char* shade_fragment = R"(
in vec3 x, n;
out vec4 color;
uniform vec3 eye, base_color, ambient;
uniform float roughness;
uniform vec3 light_at[2], light_power[2];
uniform mat4 map_from_world[2];
layout(binding = 0) uniform sampler2DShadow map0;
layout(binding = 1) uniform sampler2DShadow map1;
const float PI = 3.14159265;
vec3 brdf(vec3 normal, vec3 v, vec3 l) {
  vec3 h = normalize(v + l);
  float nv = max(dot(normal, v), 1e-3), nl = max(dot(normal, l), 1e-3), nh = max(dot(normal, h), 0.0);
  float a = roughness * roughness, t = nh * nh * (a * a - 1.0) + 1.0;
  float d = a * a / (PI * t * t);
  float g = 0.5 / (nl * sqrt(nv * nv * (1.0 - a * a) + a * a) + nv * sqrt(nl * nl * (1.0 - a * a) + a * a));
  float f = 0.04 + 0.96 * pow(1.0 - max(dot(v, h), 0.0), 5.0);
  return base_color / PI * (1.0 - f) + d * g * f;
}
#if TAPS > 0
float seen(sampler2DShadow map, mat4 from_world) {
  vec4 at = from_world * vec4(x + 4e-3 * n, 1.0);
  vec3 place = 0.5 * at.xyz / at.w + 0.5;
  if (any(lessThan(place.xy, vec2(0.0))) || any(greaterThan(place.xy, vec2(1.0)))) return 1.0;
  place.z = min(place.z, 0.99999);  // the ground is behind the map
  float sum = 0.0;
  for (int k = 0; k < TAPS; ++k) {
    float r = 0.02 * sqrt((float(k) + 0.5) / float(TAPS)), phi = 2.3999632 * float(k);
    sum += texture(map, vec3(place.xy + r * vec2(cos(phi), sin(phi)), place.z));
  }
  return sum / float(TAPS);
}
#else
float seen(sampler2DShadow map, mat4 from_world) { return 1.0; }
#endif
void main() {
  vec3 normal = normalize(n), v = normalize(eye - x), sum = base_color * ambient;
  for (int i = 0; i < 2; ++i) {
    vec3 to = light_at[i] - x;
    float cosine = dot(normal, normalize(to));
    if (cosine <= 0.0) continue;
    float part = i == 0 ? seen(map0, map_from_world[0]) : seen(map1, map_from_world[1]);
    sum += part * cosine / dot(to, to) * light_power[i] * brdf(normal, v, normalize(to));
  }
  color = vec4(sum, 1.0);
}
)";

constexpr const char* depth_vertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
void main() { gl_Position = clip_from_world * vec4(position, 1.0); }
)";
constexpr const char* depth_fragment = "void main() {}\n";

void set_matrices(const Program& program, const char* name, const Mat4* matrices, int count = 1) {
  glUniformMatrix4fv(program.location(name), count, GL_FALSE, matrices->data());
}

template <class Three>
void set_vector(const Program& program, const char* name, const Three& v) {
  glUniform3f(program.location(name), v[0], v[1], v[2]);
}

std::string taps_definition(bool shadows) {
  return "#define TAPS " + std::to_string(shadows ? ForwardFrame::taps : 0) + "\n";
}

}  // namespace

ForwardFrame::Gl::Gl(bool shadows)
    : shade_mesh("forward mesh", {mesh_vertex}, {taps_definition(shadows).c_str(), shade_fragment}),
      shade_ground("forward ground", {ground_vertex}, {taps_definition(shadows).c_str(), shade_fragment}),
      depth_only("forward map", {depth_vertex}, {depth_fragment}) {}

ForwardFrame::ForwardFrame(const RenderScene& scene, int width, int height, int threads, bool shadows)
    : scene_(scene),
      width_(width),
      height_(height),
      shadows_(shadows),
      context_(make_gl_context(threads)),
      gl_(std::make_unique<Gl>(shadows)) {
  for (const bool several : {false, true}) {
    const Gl::Target& to = several ? gl_->several : gl_->single;
    const auto attach = [&](const Renderbuffer& buffer, GLenum format, GLenum place) {
      glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, several ? 4 : 0, format, width, height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer.id());
    };
    bind(to.framebuffer, width, height);
    attach(to.color, GL_RGBA32F, GL_COLOR_ATTACHMENT0);
    attach(to.depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    check_framebuffer("forward frame");
  }
  for (const Gl::Map& map : gl_->maps) {
    glActiveTexture(GL_TEXTURE14);
    glBindTexture(GL_TEXTURE_2D, map.depth.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, map_size, map_size);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    bind(map.framebuffer, map_size, map_size);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map.depth.id(), 0);
    check_framebuffer("forward map");
  }
  gl_->mesh.emplace(scene_.meshes.front());
}

ForwardFrame::~ForwardFrame() {
  context_->make_current();
  gl_.reset();
}

void ForwardFrame::draw_maps(std::array<Mat4, 2>& map_from_world) {
  const std::vector<std::vector<Vec3>> positions = {scene_.meshes.front().positions};
  gl_->depth_only.use();
  for (std::size_t i = 0; i < 2; ++i) {
    const LightView view = fit_light_view(scene_.lights[i], positions, map_size);
    map_from_world[i] = view.clip_from_world;
    bind(gl_->maps[i].framebuffer, map_size, map_size);
    glClear(GL_DEPTH_BUFFER_BIT);
    set_matrices(gl_->depth_only, "clip_from_world", &view.clip_from_world);
    gl_->mesh->draw();
  }
}

void ForwardFrame::draw_picture(const Camera& camera, const std::array<Mat4, 2>& map_from_world) {
  bind(gl_->several.framebuffer, width_, height_);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (std::size_t i = 0; i < 2; ++i) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, gl_->maps[i].depth.id());
  }
  const Mat4 clip_from_world = camera.projection(0.1F, 20.0F) * camera.view();
  const std::array<const char*, 2> places = {"light_at[0]", "light_at[1]"};
  const std::array<const char*, 2> powers = {"light_power[0]", "light_power[1]"};
  const auto use = [&](const Program& program, const Material& material) {
    program.use();
    set_matrices(program, "clip_from_world", &clip_from_world);
    set_matrices(program, "map_from_world", map_from_world.data(), 2);
    set_vector(program, "eye", camera.position());
    set_vector(program, "base_color", material.base_color);
    set_vector(program, "ambient",
               Color(0.5F * scene_.sky.strength * (scene_.sky.zenith + scene_.sky.horizon)));
    glUniform1f(program.location("roughness"), material.roughness);
    for (std::size_t i = 0; i < 2; ++i) {
      const AreaLight& light = scene_.lights[i];
      set_vector(program, places[i], light.position);
      set_vector(program, powers[i], Color(light.size.prod() * light.radiance * light.color));
    }
  };
  use(gl_->shade_mesh, scene_.meshes.front().material);
  gl_->mesh->draw();
  use(gl_->shade_ground, scene_.ground.material);
  glUniform1f(gl_->shade_ground.location("height"), scene_.ground.height);
  glUniform1f(gl_->shade_ground.location("radius"), scene_.ground.radius);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(gl_->no_attributes.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glEnable(GL_CULL_FACE);
}

const std::vector<float>& ForwardFrame::draw_and_read(const Camera& camera) {
  context_->make_current();
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  gl_->mesh->upload(scene_.meshes.front().positions);
  std::array<Mat4, 2> map_from_world = {Mat4::Identity(), Mat4::Identity()};
  if (shadows_) draw_maps(map_from_world);
  draw_picture(camera, map_from_world);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, gl_->several.framebuffer.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, gl_->single.framebuffer.id());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, gl_->single.framebuffer.id());
  pixels_.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
  check_gl("drawing a forward frame");
  return pixels_;
}

}  // namespace lagomorph::bench
