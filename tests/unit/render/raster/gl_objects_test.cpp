#include "render/raster/gl_objects.h"

#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "render/error.h"
#include "render/raster/gl_context.h"

namespace lagomorph::render::raster {
namespace gl_objects_test {

int version() {
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return 10 * major + minor;
}

TEST(GlContext, IsACoreProfileOfVersion45OneAfterAnother) {
  for (int i = 0; i < 3; ++i) {
    const auto context = make_gl_context(2);
    EXPECT_GE(version(), 45);
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
  }
}

TEST(GlContext, ServesAnyThread) {
  int found = 0;
  std::thread([&] {
    const auto context = make_gl_context(2);
    found = version();
  }).join();
  EXPECT_GE(found, 45);
}

TEST(GlContext, TwoTakeTurnsOnAThread) {
  const auto first = make_gl_context(2);
  glClearColor(0.25F, 0.0F, 0.0F, 1.0F);
  const auto second = make_gl_context(2);
  glClearColor(0.75F, 0.0F, 0.0F, 1.0F);
  float color[4] = {};
  first->make_current();
  glGetFloatv(GL_COLOR_CLEAR_VALUE, color);
  EXPECT_EQ(color[0], 0.25F);
  second->make_current();
  glGetFloatv(GL_COLOR_CLEAR_VALUE, color);
  EXPECT_EQ(color[0], 0.75F);
}

TEST(GlContext, RefusesTheVectorWidthThatCrashes) {
  ASSERT_EQ(setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1), 0);
  EXPECT_THROW(make_gl_context(2), DeviceError);
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  EXPECT_NO_THROW(make_gl_context(2));
}

std::string message_of(const char* vertex, const char* fragment) {
  try {
    const Program program("trial", {vertex}, {fragment});
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

TEST(Program, TellsTheFirstLineOfTheLog) {
  const auto context = make_gl_context(2);
  const char* good_vertex = "void main() { gl_Position = vec4(0.0); }\n";
  const char* good_fragment = "out vec4 c;\nvoid main() { c = vec4(1.0); }\n";
  EXPECT_EQ(message_of(good_vertex, good_fragment), "");
  for (const std::string& message :
       {message_of(good_vertex, "void main() { wrong = 1.0; also_wrong = 2.0; }\n"),
        message_of("void main() { wrong = 1.0; also_wrong = 2.0; }\n", good_fragment)}) {
    EXPECT_NE(message.find("'trial'"), std::string::npos) << message;
    EXPECT_NE(message.find("wrong"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Program, TellsWhatDoesNotLink) {
  const auto context = make_gl_context(2);
  const std::string message =
      message_of("out vec2 a;\nvoid main() { a = vec2(0.0); gl_Position = vec4(0.0); }\n",
                 "in vec3 a;\nout vec4 c;\nvoid main() { c = vec4(a, 1.0); }\n");
  EXPECT_NE(message.find("link"), std::string::npos) << message;
}

TEST(Framebuffer, AnIncompleteOneIsAnError) {
  const auto context = make_gl_context(2);
  const Framebuffer framebuffer;
  const Texture texture;
  bind(framebuffer, 4, 4);
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  EXPECT_THROW(check_framebuffer("trial"), DeviceError);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 4, 4);
  EXPECT_NO_THROW(check_framebuffer("trial"));
}

TEST(CheckGl, TellsAndForgetsAnError) {
  const auto context = make_gl_context(2);
  glEnable(GL_TEXTURE_2D_MULTISAMPLE);  // no capability
  EXPECT_THROW(check_gl("trying"), DeviceError);
  EXPECT_NO_THROW(check_gl("trying"));
}

}  // namespace gl_objects_test
}  // namespace lagomorph::render::raster
