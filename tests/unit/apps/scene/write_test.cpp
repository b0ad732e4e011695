#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "apps/scene/keys.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace write_test {

/// Fills every key with a random valid value.
class RandomFill : public KeyVisitor {
public:
  explicit RandomFill(unsigned seed) : random_(seed) {}

  void key(const Key& k, Field field) override {
    std::visit([&](auto* value) { fill(k, *value); }, field);
  }
  void table(const Table&, const Elements& elements) override {
    if (elements.kind != Elements::Kind::one) {
      elements.resize(below(elements.kind == Elements::Kind::list ? 4 : 2));
    }
    for (int i = 0; i < elements.size(); ++i) elements.visit(i, *this);
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  /// Of any size between the bounds; `decades` is how large and how small a number may be.
  double number(const Bounds& b, double decades) {
    const double size = std::pow(10.0, decades * (2.0 * unit() - 1.0));
    if (std::isfinite(b.low) && std::isfinite(b.high))
      return b.low + (b.high - b.low) * (0.01 + 0.98 * unit());
    if (std::isfinite(b.low)) return b.low + size;
    return below(2) == 0 ? size : -size;
  }
  void fill(const Key&, bool& value) { value = below(2) == 0; }
  void fill(const Key& k, int& value) {
    value = static_cast<int>(std::max(k.bounds.low, -1e6) +
                             (std::min(k.bounds.high, 1e6) - std::max(k.bounds.low, -1e6)) * unit());
    if (k.holds == nullptr) return;
    do value = below(2) == 0 ? below(8) : 1 << below(16);
    while (!k.bounds.hold(value) || !k.holds(value));
  }
  void fill(const Key&, std::uint32_t& value) { value = static_cast<std::uint32_t>(random_()); }
  void fill(const Key& k, double& value) { value = number(k.bounds, 300.0); }
  void fill(const Key& k, float& value) { value = static_cast<float>(number(k.bounds, 15.0)); }
  void fill(const Key& k, std::string& value) {
    if (k.choices != nullptr) {
      value = pick(k.choices());
      return;
    }
    value.clear();
    for (int i = 0; i < 8; ++i) {
      value += pick({"a", "B", "7", " ", ".", "-", "_", "'", "#", "=", "\u00e9", "\u5154", "\U0001F430"});
    }
    value += std::to_string(++names_);
  }
  std::string pick(const std::vector<std::string>& all) {
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
  }
  template <class T>
  void fill(const Key& k, std::optional<T>& value) {
    value.reset();
    if (below(2) == 0) fill(k, value.emplace());
  }
  template <class Scalar, int n>
  void fill(const Key& k, Eigen::Matrix<Scalar, n, 1>& value) {
    for (int i = 0; i < n; ++i) fill(k, value[i]);
  }
  void fill(const Key& k, render::Color& value) {
    for (int i = 0; i < 3; ++i) fill(k, value[i]);
  }
  void fill(const Key& k, sim::BoxSelector& value) {
    fill(k, value.min);
    value.max = value.min + value.min.cwiseAbs();
  }
  void fill(const Key&, std::array<double, 2>& value) {
    value[0] = 1e3 * (unit() - 0.5);
    value[1] = value[0] + 1.0 + unit();
  }
  void fill(const Key& k, std::vector<int>& value) {
    value.resize(static_cast<std::size_t>(below(5)));
    for (int& v : value) fill(k, v);
  }
  void fill(const Key& k, std::vector<std::string>& value) {
    value.clear();
    if (below(2) == 0) value.push_back(k.choices().front());
  }

  void fill(const Key&, std::vector<std::array<double, 2>>& value) {
    value.resize(static_cast<std::size_t>(below(4)));
    double t = -unit();
    for (auto& pair : value) pair = {t += unit() + 1e-3, 1e3 * unit()};
  }
  void fill(const Key& k, std::vector<double>& value) {
    value.resize(static_cast<std::size_t>(below(4)));
    for (double& v : value) v = number(k.bounds, 300.0);
  }
  void fill(const Key& k, std::vector<sim::Vec3>& value) {
    value.resize(static_cast<std::size_t>(below(4)));
    for (sim::Vec3& v : value) fill(k, v);
  }

  std::mt19937 random_;
  int names_ = 0;  // each its own
};

void settle(sim::MaterialSettings& m, RandomFill& random) {
  m.young = m.poisson = m.mu = m.lambda = m.C = m.D = m.C10 = m.C01 = m.bulk = std::nullopt;
  m.data.clear();
  if (m.model != "neo_hookean") m.moduli = "lecture";
  if (m.model == "stress_strain") {
    m.data = {{-0.1, -2e3}, {0.25, 1e3 / 3.0}};
    m.poisson = 1.0 / 3.0;
    m.preset = "none";
    return;
  }
  const int kind = random.below(m.model == "neo_hookean" || m.model == "mooney_rivlin" ? 3 : 2);
  if (kind == 0) m.young = 12345.678, m.poisson = 1.0 / 3.0;
  if (kind == 1) m.mu = 0.1, m.lambda = 0.3;
  if (kind == 2 && m.model == "neo_hookean") m.C = 1e-300, m.D = 1e300;
  if (kind == 2 && m.model == "mooney_rivlin") m.C10 = 1e-300, m.C01 = 0.0, m.bulk = 1e300;
}

/// What camera, panels and region must hold together.
void settle_views(SceneDesc& s, RandomFill& random) {
  CameraDesc& c = s.camera;
  if (c.turntable.turns) c.turntable.period.reset();
  for (std::size_t i = 0; i < c.key.size(); ++i) {
    CameraKey& key = c.key[i];
    key = {};
    (i % 2 == 0 ? key.time : key.frame)
        .emplace(i % 2 == 0 ? static_cast<double>(i) / s.time.fps : static_cast<double>(i));
    key.focus_distance = 1.0F / static_cast<float>(1 + random.below(9));
  }
  const Eigen::Vector3d position = c.position.cast<double>(), look_at = c.look_at.cast<double>();
  c.view = "none";
  c.up = position.cross(look_at).normalized().cast<float>();
  s.layout = {.columns = random.below(3), .gap = random.below(5)};
  if (!s.panel.empty()) s.render.width = s.render.height = 500 + random.below(99);
  const bool front = random.below(2) == 0;
  if (front && !s.panel.empty()) c.up = render::CameraSettings().up;
  for (std::size_t i = 0; i < s.panel.size(); ++i) {
    PanelDesc& p = s.panel[i];
    p.title = "{frame} \u00e9 " + std::to_string(i);
    p.view = front ? "front" : "same";
    p.position.reset(), p.look_at.reset(), p.up.reset();
    p.range.reset();
    p.colormap = "same";
  }
  s.render.region.clear();
  if (s.render.width > 4 && s.render.height > 4) s.render.region = {1, 0, s.render.width, 3};
  if (!s.panel.empty() || !s.render.region.empty()) s.render.channels = {"depth"};
  if (s.render.channel_format == "png") s.render.channels = {"normal", "body_id"};  // of those that fit
}

/// Makes true what keys must hold together.
void settle(SceneDesc& s, RandomFill& random) {
  s.caption.text = "{frame:04} \u00e9 'it' # " + std::to_string(random.below(9));
  if (s.body.empty()) {
    s.body.resize(1);
    s.body[0].physics.name = "only";
    s.body[0].mesh = "a.msh";
  }
  for (BodyDesc& b : s.body) {
    settle(b.physics.material, random);
    for (sim::RegionSettings& region : b.physics.region) {
      region.tag.push_back(7);
      if (!region.material) continue;
      settle(*region.material, random);
      region.material->fibre = b.physics.material.fibre;  // what a region leaves open is the body's
    }
    for (sim::FieldSettings& field : b.physics.field) {
      field.radius = 0.25;
      field.values.resize(field.points.size(), 0.5);
      if (!field.file.empty()) field.points.clear(), field.values.clear();
    }
    for (sim::PinSettings& p : b.physics.pin) {
      p.vertices.push_back(3);
      p.axes.push_back("z");
      for (std::size_t i = 0; i < p.key.size(); ++i) p.key[i].time = 0.1 * static_cast<double>(i);
      if (!p.key.empty()) p.path.clear();
      if (!p.path.empty() && !p.path_fps) p.path_fps = 24.0;
      if (p.path.empty()) p.path_fps.reset();
    }
    for (sim::SpringSettings& spring : b.physics.spring) spring.vertices.push_back(3);
  }
  settle_views(s, random);
  s.energy_plot.curves.emplace_back("total");
  if (s.energy_plot.range) s.energy_plot.range = {-1.0, 2.5};
  s.ground.fade_start = 0.3F * s.ground.radius;
}

/// Every value as it stands, by its path.
class Flat : public KeyVisitor {
public:
  using Value = std::variant<bool, int, std::uint32_t, double, float, std::string, sim::Vec3, render::Vec2,
                             render::Vec3, std::array<double, 2>, std::vector<int>, std::vector<std::string>,
                             std::vector<std::array<double, 2>>, std::vector<double>, std::vector<sim::Vec3>,
                             std::monostate>;
  std::vector<std::pair<std::string, Value>> values;

  void key(const Key& k, Field field) override {
    std::visit([&](auto* value) { add(k.name, *value); }, field);
  }
  void table(const Table& t, const Elements& elements) override {
    values.emplace_back(t.name, elements.size());
    for (int i = 0; i < elements.size(); ++i) elements.visit(i, *this);
  }

private:
  template <class T>
  void add(const char* name, const T& value) {
    values.emplace_back(name, Value(value));
  }
  template <class T>
  void add(const char* name, const std::optional<T>& value) {
    if (value) {
      add(name, *value);
    } else {
      values.emplace_back(name, Value(std::monostate()));
    }
  }
  void add(const char* name, const render::Color& value) { add(name, render::Vec3(value.matrix())); }
  void add(const char* name, const sim::BoxSelector& value) {
    add(name, value.min);
    add(name, value.max);
  }
};

std::vector<std::pair<std::string, Flat::Value>> flat(SceneDesc scene) {
  Flat all;
  visit_scene(scene, all);
  return all.values;
}

TEST(SceneToToml, ReadsBackAsTheSameScene) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    RandomFill random(seed);
    SceneDesc scene;
    visit_scene(scene, random);
    settle(scene, random);
    const std::string text = scene_to_toml(scene);
    const SceneDesc read = parse_scene(text, "scene.toml", {});
    ASSERT_EQ(flat(scene), flat(read)) << text;
    ASSERT_EQ(text, scene_to_toml(read));
  }
}

TEST(SceneToToml, WritesEveryKeyButOptionalOnesThatAreNotGiven) {
  const std::string text =
      scene_to_toml(parse_scene("light = []\n[[body]]\nmesh = 'a.msh'\n", "scenes/b.toml", {}));
  for (const char* line : {
           "name = \"b\"\n",
           "\nlight = []\n",
           "\n[time]\nfps = 30.0  # 1/s\nframes = 150\nsubsteps = 1\nintegrator = \"backward_euler\"\n"
           "gravity = [0.0, -9.81, 0.0]  # m/s^2\n",
           "\n[[body]]\nname = \"body0\"\nmesh = \"a.msh\"\nelement = \"mesh\"\ndensity = 1000.0  # kg/m^3\n",
           "\nmaterial = { model = \"stable_neo_hookean\", preset = \"none\", young = 100000.0, poisson = "
           "0.3, "
           "moduli = \"lecture\", data = [] }\n",
           "\npin = []\n",
           "\n# orthographic is not given\n",
           "\n[render.raster]\nmultisample = 4\n",
           "\n[background]\n# color is not given\n",
       }) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\nin\n" << text;
  }
}

TEST(SceneToToml, KeepsFloatsOfEachSize) {
  std::mt19937 random(1);
  SceneDesc scene = parse_scene("[[body]]\nmesh = 'a.msh'\n", "b.toml", {});
  for (int i = 0; i < 2000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    float value = 0.0F;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    scene.render.exposure = value;
    scene.time.gravity.x() =
        std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 2000) - 1090);
    const SceneDesc read = parse_scene(scene_to_toml(scene), "b.toml", {});
    ASSERT_EQ(read.render.exposure, value);
    ASSERT_EQ(read.time.gravity.x(), scene.time.gravity.x());
  }
}

}  // namespace write_test
}  // namespace lagomorph::apps
