#include "apps/scene/camera_moves.h"

#include <cmath>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/scene/scene.h"
#include "render/camera.h"

namespace lagomorph::apps {
namespace camera_moves_test {

const std::string body = "\n[[body]]\nmesh = \"a.msh\"\n";

SceneDesc scene_of(const std::string& text) { return parse_scene(text + body, "a.toml", {}); }
CameraMoves moves_of(const SceneDesc& s) {
  return {s.camera, s.time, static_cast<double>(s.render.width) / s.render.height};
}

TEST(CameraMoves, WithoutMovesEveryFrameIsTheCameraItself) {
  const SceneDesc scene = scene_of("[camera]\nposition = [1, 2, 3]\nlook_at = [0.1, 0.2, 0.3]\nfov = 31.7");
  for (const int frame : {0, 7, 149}) {
    const render::CameraSettings c = moves_of(scene).at(frame, std::nullopt);
    EXPECT_EQ(c.position, scene.camera.position);
    EXPECT_EQ(c.look_at, scene.camera.look_at);
    EXPECT_EQ(c.fov, scene.camera.fov);
  }
}

TEST(CameraMoves, PassThroughTheirKeys) {
  const SceneDesc scene = scene_of(
      "[time]\nfps = 10\n[camera]\nfov = 30\n[[camera.key]]\ntime = 0\nposition = [0, 1, 4]\n"
      "[[camera.key]]\ntime = 1\nfov = 40\n[[camera.key]]\nframe = 20\nposition = [4, 1, 0]\nfov = 20");
  const CameraMoves moves = moves_of(scene);
  EXPECT_EQ(moves.at(0, std::nullopt).position, render::Vec3(0, 1, 4));
  EXPECT_EQ(moves.at(0, std::nullopt).fov, 40.0F) << "that of the first key that gives it";
  EXPECT_EQ(moves.at(10, std::nullopt).position, render::Vec3(2, 1, 2));
  EXPECT_EQ(moves.at(20, std::nullopt).position, render::Vec3(4, 1, 0));
  EXPECT_EQ(moves.at(20, std::nullopt).fov, 20.0F);
  EXPECT_EQ(moves.at(99, std::nullopt).position, render::Vec3(4, 1, 0)) << "it stays";
  EXPECT_EQ(moves.at(5, std::nullopt).look_at, scene.camera.look_at) << "what no key gives is the camera's";
}

/// A smooth move starts and ends at rest, a linear one is as quick everywhere.
TEST(CameraMoves, SmoothOrLinear) {
  const std::string keys =
      "[[camera.key]]\nframe = 0\nposition = [0, 0, 3]\n[[camera.key]]\nframe = 100\nposition = [10, 0, 3]";
  const CameraMoves smooth = moves_of(scene_of(keys)),
                    linear = moves_of(scene_of("[camera]\ninterpolation = \"linear\"\n" + keys));
  EXPECT_NEAR(linear.at(10, std::nullopt).position.x(), 1.0F, 1e-5F);
  EXPECT_NEAR(smooth.at(10, std::nullopt).position.x(), 10 * 0.01 * (3 - 0.2), 1e-5);
  EXPECT_NEAR(smooth.at(50, std::nullopt).position.x(), 5.0F, 1e-5F);
}

TEST(CameraMoves, Views) {
  struct Case {
    const char* view;
    render::Vec3 from, up;
  };
  const float third = 1.0F / std::sqrt(3.0F);
  for (const Case& c : {Case{"front", {0, 0, 1}, {0, 1, 0}}, Case{"back", {0, 0, -1}, {0, 1, 0}},
                        Case{"left", {-1, 0, 0}, {0, 1, 0}}, Case{"right", {1, 0, 0}, {0, 1, 0}},
                        Case{"top", {0, 1, 0}, {0, 0, -1}}, Case{"bottom", {0, -1, 0}, {0, 0, 1}},
                        Case{"isometric", {third, third, third}, {0, 1, 0}}}) {
    const SceneDesc scene = scene_of(
        std::string("[camera]\nposition = [3, 0, 4]\nlook_at = [0, 0, 0]\nview = \"") + c.view + "\"");
    const render::CameraSettings at = moves_of(scene).at(3, std::nullopt);
    EXPECT_LT((at.position - 5.0F * c.from).norm(), 1e-5F) << c.view << ": as far away as position is";
    EXPECT_EQ(at.up, c.up) << c.view;
  }
}

TEST(CameraMoves, ATurntableComesBack) {
  const CameraMoves moves =
      moves_of(scene_of("[time]\nframes = 8\n[camera]\nposition = [0, 1, 2]\nlook_at = [0, 0.5, "
                        "0]\nturntable = { turns = 1 }"));
  EXPECT_EQ(moves.at(0, std::nullopt).position, render::Vec3(0, 1, 2));
  EXPECT_LT((moves.at(2, std::nullopt).position - render::Vec3(2, 1, 0)).norm(), 1e-6F)
      << "counterclockwise from above";
  EXPECT_LT((moves.at(4, std::nullopt).position - render::Vec3(0, 1, -2)).norm(), 1e-6F);
  EXPECT_LT((moves.at(8, std::nullopt).position - render::Vec3(0, 1, 2)).norm(), 1e-6F);
  const CameraMoves other =
      moves_of(scene_of("[time]\nfps = 4\n[camera]\nposition = [0, 1, 2]\nlook_at = [0, 0.5, 0]\n"
                        "turntable = { period = -2, start = 90 }"));
  EXPECT_LT((other.at(0, std::nullopt).position - render::Vec3(2, 1, 0)).norm(), 1e-6F);
  EXPECT_LT((other.at(2, std::nullopt).position - render::Vec3(0, 1, 2)).norm(), 1e-6F) << "clockwise";
}

/// For motion blur: between frames the camera is where its own moves have it.
TEST(CameraMoves, GoOnBetweenFrames) {
  const SceneDesc turns = scene_of(
      "[time]\nframes = 8\n[camera]\nposition = [0, 1, 2]\nlook_at = [0, 1, 0]\nturntable = { turns = 1 }");
  const render::CameraSettings c = moves_of(turns).at(0.5, std::nullopt);
  const auto angle = static_cast<float>(std::acos(-1.0) / 8.0);
  EXPECT_LT((c.position - render::Vec3(2.0F * std::sin(angle), 1.0F, 2.0F * std::cos(angle))).norm(), 1e-6F);
  const SceneDesc keys = scene_of(
      "[time]\nfps = 10\n[camera]\ninterpolation = \"linear\"\n[[camera.key]]\nframe = 0\nfov = 20\n"
      "[[camera.key]]\nframe = 10\nfov = 40");
  EXPECT_FLOAT_EQ(moves_of(keys).at(2.5, std::nullopt).fov, 25.0F);
}

TEST(CameraMoves, ZoomMagnifiesTheMiddle) {
  const SceneDesc plain = scene_of(""), zoomed = scene_of("[camera]\nzoom = 2.5");
  const render::Camera a(moves_of(plain).at(0, std::nullopt), 640, 360),
      b(moves_of(zoomed).at(0, std::nullopt), 640, 360);
  const render::Vec3 point(0.1F, 0.55F, -0.2F);
  const render::Vec2 middle(320, 180);
  EXPECT_LT(((b.project(point) - middle) - 2.5F * (a.project(point) - middle)).norm(), 1e-2F);
  const SceneDesc high = scene_of("[camera]\northographic = 3\nzoom = 2");
  EXPECT_FLOAT_EQ(*moves_of(high).at(0, std::nullopt).orthographic, 1.5F);
}

/// The box's corners in the picture, as parts of its width and height from the middle.
Eigen::Array2d reach(const SceneDesc& scene, const Eigen::AlignedBox3d& box, int frame) {
  const int width = scene.render.width, height = scene.render.height;
  const render::Camera camera(moves_of(scene).at(frame, box), width, height);
  Eigen::Array2d most = Eigen::Array2d::Zero();
  for (int i = 0; i < 8; ++i) {
    const render::Vec3 corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)).cast<float>();
    EXPECT_GT(camera.depth(corner), 0.0F);
    const render::Vec2 at = camera.project(corner);
    most = most.max(Eigen::Array2d(std::abs(at.x() / static_cast<float>(width) - 0.5F),
                                   std::abs(at.y() / static_cast<float>(height) - 0.5F)));
  }
  return most;
}

TEST(CameraMoves, AFittedBoxTouchesTheMargin) {
  using sim::Vec3;
  const Eigen::AlignedBox3d tall(Vec3(-0.2, 1, -0.1), Vec3(0.3, 4, 0.1)),
      wide(Vec3(-5, 0, -1), Vec3(3, 0.5, 1)), deep(Vec3(-1, 0, -20), Vec3(1, 1, 20));
  for (const char* const camera :
       {"margin = 0.1", "margin = 0.1\northographic = 1", "margin = 0.1\nview = \"isometric\"",
        "margin = 0.1\nposition = [5, 9, -3]\nfov = 80", "margin = 0.1\nview = \"top\"\northographic = 2"}) {
    for (const Eigen::AlignedBox3d& box : {tall, wide, deep}) {
      const SceneDesc scene = scene_of(std::string("[camera]\nframe = \"rest\"\n") + camera);
      EXPECT_NEAR(reach(scene, box, 0).maxCoeff(), 0.4, 1e-4) << camera;
    }
  }
  const SceneDesc turning =
      scene_of("[time]\nframes = 90\n[camera]\nframe = \"motion\"\nmargin = 0.1\nturntable = { turns = 1 }");
  double most = 0.0;
  for (int frame = 0; frame < 90; ++frame) most = std::max(most, reach(turning, wide, frame).maxCoeff());
  EXPECT_LE(most, 0.4 + 1e-3) << "on the whole way round";
  EXPECT_GE(most, 0.38);
}

TEST(CameraMoves, CenterLooksAtTheMiddleFromWhereItIs) {
  const SceneDesc scene = scene_of("[camera]\nframe = \"center\"");
  const render::CameraSettings c =
      moves_of(scene).at(0, Eigen::AlignedBox3d(sim::Vec3(1, 1, 1), sim::Vec3(2, 3, 4)));
  EXPECT_EQ(c.position, scene.camera.position);
  EXPECT_EQ(c.look_at, render::Vec3(1.5F, 2, 2.5F));
}

/// Of what the pictures depend on.
TEST(CameraMoves, AreInThePicturesIdentity) {
  const auto keys = [](const std::string& text) {
    std::string all;
    for (const ResolvedKey& k : picture_keys(scene_of(text))) all += k.key + "=" + k.value + "\n";
    return all;
  };
  EXPECT_EQ(keys(""), "");
  EXPECT_EQ(keys("[time]\nframes = 7"), "");
  EXPECT_EQ(keys("[time]\nframes = 7\n[camera]\nturntable = { period = 4 }"),
            "camera.turntable.period=4.0\n");
  EXPECT_EQ(keys("[time]\nframes = 7\n[camera]\nturntable = { turns = 1 }"),
            "camera.turntable.turns=1.0\ntime.frames=7\n");
  EXPECT_EQ(keys("[[camera.key]]\ntime = 1\nfov = 20"),
            "camera.key=1 of them\ncamera.key.0.time=1.0\ncamera.key.0.fov=20.0\n");
}

std::string error_of(const std::string& text) {
  try {
    scene_of(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(CameraMoves, WrongKeysAreTold) {
  const std::string key = "[[camera.key]]\n";
  EXPECT_EQ(error_of(key + "fov = 20"), "a.toml:1:1: camera.key.0 needs a time or a frame, one of them");
  EXPECT_EQ(error_of(key + "time = 1\nframe = 3\nfov = 20"),
            "a.toml:1:1: camera.key.0 needs a time or a frame, one of them");
  EXPECT_EQ(error_of(key + "time = 1"),
            "a.toml:1:1: camera.key.0 says nothing; give position, look_at, up, fov, orthographic, zoom, "
            "focus_distance or f_stop");
  EXPECT_EQ(error_of(key + "time = 1\nfov = 20\n" + key + "frame = 30\nfov = 25"),
            "a.toml:4:1: camera.key.1 is at 1 s and must be later than camera.key.0, at 1 s");
  EXPECT_EQ(error_of(key + "frame = 30\nfov = 20\n" + key + "time = 0.5\nfov = 25"),
            "a.toml:4:1: camera.key.1 is at 0.5 s and must be later than camera.key.0, at 1 s");
  EXPECT_EQ(error_of(key + "time = 1\northographic = 2"),
            "a.toml:1:1: camera.key.0 has an orthographic height, but camera.orthographic is not given");
  EXPECT_EQ(error_of("[camera]\northographic = 1\n" + key + "time = 1\nfov = 2"),
            "a.toml:3:1: camera.key.0 has a fov, but the camera is orthographic");
  EXPECT_EQ(error_of("[camera]\nview = \"front\"\n" + key + "time = 1\nposition = [1, 1, 1]"),
            "a.toml:3:1: camera.key.0 has a position or up, but camera.view says from where it looks");
  EXPECT_EQ(error_of("[camera]\nview = \"front\"\nup = [1, 0, 0]"),
            "a.toml:3:6: camera.up has no effect with camera.view = \"front\"");
  EXPECT_EQ(error_of("[camera]\nturntable = { turns = 1, period = 2 }"),
            "a.toml:2:13: camera.turntable has turns and a period; give one of them");
  EXPECT_EQ(error_of("[camera]\nview = \"fornt\""),
            "a.toml:2:8: unknown camera.view 'fornt'; did you mean 'front'? Known are none, front, back, "
            "left, right, top, bottom, isometric");
  EXPECT_EQ(error_of(key + "frame = 0\nposition = [0, 0, 3]\nlook_at = [0, 0, 0]\n" + key +
                     "frame = 4\nposition = [0, 0, -3]\n[camera]\ninterpolation = \"linear\""),
            "a.toml:4:11: in frame 2 camera.position and camera.look_at are the same point");
  const std::string through =
      key + "frame = 0\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n" + key +
      "frame = 4\nposition = [0, 0, -3]\n[time]\nfps = 16\n[camera]\ninterpolation = \"linear\"\n";
  EXPECT_EQ(error_of(through), "no error") << "frames 2 and 3 are beside what is looked at";
  EXPECT_EQ(
      error_of(through + "shutter = 0.5"),
      "a.toml:4:11: while the shutter of frame 3 is open camera.position and camera.look_at are the same "
      "point");
}

/// The box is in what the strip and the margins leave and touches their border; on a turntable at every turn.
TEST(CameraMoves, LeaveAStripFree) {
  using sim::Vec3;
  const Eigen::AlignedBox3d box(Vec3(-0.5, 0.1, -0.3), Vec3(0.7, 1.3, 0.9)),
      wide(Vec3(-5, 0, -1), Vec3(3, 0.5, 1));
  constexpr double strip = 0.2, margin = 0.05, slack = 1e-4;
  const auto check = [&](const std::string& text, const Eigen::AlignedBox3d& of, bool turns) {
    const SceneDesc scene =
        scene_of("[time]\nframes = 8\n[camera]\nframe = \"motion\"\nposition = [1, 2, 3]\n" + text);
    const double width = scene.render.width, height = scene.render.height;
    for (int frame = 0; frame < (turns ? 8 : 1); ++frame) {
      const render::Camera camera(moves_of(scene).at(frame, of, strip), scene.render.width,
                                  scene.render.height);
      double left = 1.0, right = 0.0, top = 1.0, bottom = 0.0;
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner = of.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
        const render::Vec2 at = camera.project(corner.cast<float>());
        left = std::min(left, at.x() / width);
        right = std::max(right, at.x() / width);
        top = std::min(top, at.y() / height);
        bottom = std::max(bottom, at.y() / height);
      }
      EXPECT_GE(left, margin - slack) << text << frame;
      EXPECT_LE(right, 1.0 - strip - margin + slack) << text << frame;
      EXPECT_GE(top, margin - slack) << text << frame;
      EXPECT_LE(bottom, 1.0 - margin + slack) << text << frame;
      const bool across = left < margin + slack && right > 1.0 - strip - margin - slack;
      EXPECT_TRUE(turns || across || std::min(top, 1.0 - bottom) < margin + slack) << text;
    }
  };
  for (const std::string size :
       {"[render]\nwidth = 640\nheight = 360", "[render]\nwidth = 300\nheight = 400"}) {
    for (const std::string projection : {"", "orthographic = 2\n", "fov = 90\n"}) {
      for (const Eigen::AlignedBox3d& of : {box, wide}) {
        check(projection + size, of, false);
        check(projection + "turntable = { turns = 1 }\n" + size, of, true);
      }
    }
  }
  // Zoom magnifies the middle of what is free.
  const SceneDesc scene = scene_of("[camera]\nframe = \"rest\"\nzoom = 2");
  const render::Camera camera(moves_of(scene).at(0, box, strip), 1280, 720);
  EXPECT_NEAR(camera.project(box.center().cast<float>()).x(), 0.4F * 1280, 40.0F);
}

}  // namespace camera_moves_test
}  // namespace lagomorph::apps
