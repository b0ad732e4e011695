#include "apps/video/process.h"
#include "tests/unit/apps/preview/preview_fixture.h"

/// `lagomorph preview` as scripts see it.
namespace lagomorph::tests {
namespace preview_command_test {

using Json = nlohmann::json;
using PreviewCommand = PreviewFixture;

bool has_ffmpeg() {
  return apps::run_process({"ffmpeg", "-version"}, [] { return false; }).found;
}

TEST_F(PreviewCommand, ShowsARun) {
  expect(0, run("run"));
  const Json json = json_of("run");
  EXPECT_EQ(json["headline"], "bar: 4 frames, 0.13 s at 30 fps, all steps converged");
  EXPECT_EQ(json["pictures"], Json::parse("[0, 1, 2, 3]"));
  EXPECT_EQ(json["remarks"], Json::array());
  EXPECT_EQ(render::read_png_header(made("run", "contact_sheet.png"), "sheet").height, 84 + 2 * 78 + 18 + 32);
  const std::string summary = made("run", "summary.md");
  EXPECT_TRUE(contains(summary, "## bar: 4 frames")) << summary;
  EXPECT_TRUE(contains(summary, "\n![Contact sheet of bar](contact_sheet.png)\n")) << summary;
  EXPECT_TRUE(contains(summary, "| size | 64 x 48 pixels |")) << summary;
  EXPECT_FALSE(contains(summary, "data:"));
  for (const auto& file : json["files"])
    EXPECT_EQ(made("run", file["name"]).size(), file["bytes"].get<std::size_t>()) << file;
  EXPECT_EQ(count_files(at("run/preview")), static_cast<int>(json["files"].size()));  // and no leftovers
}

TEST_F(PreviewCommand, ShowsPicturesThatOthersMade) {
  add_pictures("shots");
  dir_.write("shots/cover.png", plain_png(8, 8, 1, 2, 3));
  const Json json = json_of("shots");
  EXPECT_EQ(json["headline"], "shots: 3 pictures, not made by Lagomorph, so without energies");
  EXPECT_EQ(json["by_lagomorph"], false);
  EXPECT_EQ(json["remarks"], Json::parse(R"(["a PNG file without a number in its name is left out"])"));
  EXPECT_FALSE(contains(made("shots", "summary.md"), "energy |"));
}

TEST_F(PreviewCommand, LeavesTheSameBytesEachTime) {
  add_pictures("shots", 1, 4);
  EXPECT_EQ(preview("shots", {"--threads", "1"}).status, 0);
  EXPECT_EQ(preview("shots", {"--threads", "2", "-o", at("other").string()}).status, 0);
  const auto once = tree(at("shots/preview")), again = tree(at("other"));
  EXPECT_EQ(once, again);
  EXPECT_TRUE(once.contains("contact_sheet.png"));
}

TEST_F(PreviewCommand, MakesAnimationsWithFfmpeg) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not here";
  add_pictures("100% shots", 1, 3, 401, 33);
  const Json json = json_of("100% shots");
  Json animations = Json::array();
  for (const auto& file : json["files"]) {
    if (file.contains("fps"))
      animations.push_back({file["name"], file["width"], file["frames"], file["fps"]});
  }
  EXPECT_EQ(animations,
            Json::parse(R"([["animation.webp", 401, 3, 30.0], ["animation.gif", 320, 2, 15.0]])"));
  EXPECT_EQ(made("100% shots", "animation.webp").substr(8, 4), "WEBP");
  EXPECT_EQ(made("100% shots", "animation.gif").substr(0, 6), "GIF89a");
}

TEST_F(PreviewCommand, DoesWithoutFfmpeg) {
  add_pictures("shots");
  dir_.write("shots/preview/animation.gif", "of an earlier preview");
  const Json json = json_of("shots", {}, {.environment = {{"PATH", at("nowhere").string()}}});
  EXPECT_EQ(json["remarks"], Json::parse(R"(["no animation: ffmpeg is not on the PATH"])"));
  EXPECT_FALSE(is_made("shots", "animation.gif"));
  EXPECT_TRUE(is_made("shots", "contact_sheet.png"));
}

TEST_F(PreviewCommand, ShowsASingleFrame) {
  expect(0, run("run"));
  EXPECT_EQ(json_of("run", {"--frames", "2"})["headline"], "bar: 1 of 4 frames, all steps converged");
  EXPECT_FALSE(is_made("run", "animation.gif"));
  EXPECT_EQ(json_of("run", {"--frames", "0"})["headline"], "bar: 1 of 4 frames, the initial state");
}

TEST_F(PreviewCommand, ShowsPartOfARun) {
  expect(0, run("run", {"--frames", "0..1"}));
  EXPECT_EQ(json_of("run")["headline"], "bar: 2 of 4 frames, 66.7 ms at 30 fps, all steps converged");
  expect(0, run("run"));
  std::filesystem::remove(at("run/frames/frame_0002.png"));
  EXPECT_EQ(json_of("run")["remarks"],
            Json::parse(R"(["a picture is missing between the first and the last: 2"])"));
}

/// Pictures of every second frame play half as many a second.
TEST_F(PreviewCommand, PlaysAtThePaceOfTheScene) {
  expect(0, run("run", {"--every", "2", "--set", "time.frames=8"}));
  const Json json = json_of("run");
  EXPECT_EQ(json["headline"], "bar: 4 of 8 frames, 0.27 s at 15 fps, all steps converged");
  int animations = 0;
  for (const Json& file : json["files"]) {
    if (!file.contains("fps")) continue;
    EXPECT_EQ(file["fps"], 15.0) << file;
    ++animations;
  }
  EXPECT_EQ(animations, 2);
  EXPECT_TRUE(contains(made("run", "index.html"), "{\"rate\":15,")) << "the player";
  // One that is missing does not slow them down.
  std::filesystem::remove(at("run/frames/frame_0004.png"));
  EXPECT_TRUE(contains(json_of("run")["headline"], "at 15 fps"));
}

TEST_F(PreviewCommand, ShowsASimulationAndSaysHowToDrawIt) {
  expect(0, simulate("it's"));
  dir_.write("it's/preview/contact_sheet.png", "of an earlier preview");
  const Json json = json_of("it's");
  EXPECT_EQ(json["headline"], "bar: 4 frames, 0.13 s at 30 fps, not drawn, all steps converged");
  const std::string command = "lagomorph render '" + dir_.path().string() + "/it'\\''s'";
  EXPECT_EQ(json["remarks"][0], "there are no pictures; this draws them: " + command);
  EXPECT_FALSE(is_made("it's", "contact_sheet.png"));
}

TEST_F(PreviewCommand, TellsFromADownloadWithoutRecords) {
  expect(0, run("run"));
  const std::string whole = json_of("run").dump();
  std::filesystem::remove_all(at("run/records"));
  EXPECT_EQ(json_of("run").dump(), whole);
}

TEST_F(PreviewCommand, ShowsWhatIsThereOfDamagedPictures) {
  add_pictures("shots", 1, 4);
  dir_.write("shots/shot2.png", "no picture");
  dir_.write("shots/shot3.png", plain_png(10, 30, 9, 9, 9));
  const Json json = json_of("shots");
  EXPECT_EQ(json["unreadable"], Json::parse("[2]"));
  ASSERT_EQ(json["remarks"].size(), 2U);
  EXPECT_TRUE(contains(json["remarks"][0], "a picture cannot be read: 2 (")) << json["remarks"];
  EXPECT_EQ(json["remarks"][1], "another size than 48 x 32: 3");
  EXPECT_TRUE(contains(made("shots", "summary.md"), "- ⚠️ another size than 48 x 32: 3\n"));
}

TEST_F(PreviewCommand, RefusesWhatShowsNothing) {
  EXPECT_TRUE(contains(refusal(2, "nowhere"), "there is no such run"));
  dir_.write("empty/readme.txt", "no picture");
  EXPECT_TRUE(contains(refusal(2, "empty"), "has no numbered PNG file to show"));
  add_pictures("shots");
  EXPECT_TRUE(
      contains(refusal(2, "shots", {"--frames", "7..9"}), "no numbered PNG file of frames 7..9 to show"));
  dir_.write("broken/1.png", "no picture");
  EXPECT_TRUE(contains(refusal(2, "broken"), "1.png: "));
  expect(0, run("run"));
  EXPECT_TRUE(contains(refusal(2, "run", {"--frames", "0..9"}), "the scene's last frame is 3"));
  dir_.write("run/run.json", "{}");
  EXPECT_TRUE(contains(refusal(2, "run"), "is not a run's run.json"));
}

TEST_F(PreviewCommand, TellsAFolderThatCannotBeWritten) {
  add_pictures("shots");
  if (::geteuid() != 0) {
    std::filesystem::permissions(at("shots"), std::filesystem::perms(0555));
    refusal(4, "shots");
    std::filesystem::permissions(at("shots"), std::filesystem::perms(0755));
    return;
  }
  std::filesystem::permissions(at("shots"), std::filesystem::perms(0755));
  refusal(4, "shots", {}, {.user = 65534});
}

TEST_F(PreviewCommand, KeepsOddNamesFromMeaningAnything) {
  const std::string odd = "a|b <i>&\"c' `d` *e*";
  add_pictures(odd, 1, 2);
  EXPECT_EQ(preview(odd).status, 0);
  const std::string summary = made(odd, "summary.md");
  EXPECT_TRUE(contains(summary, "## a\\|b &lt;i>&amp;\"c' \\`d\\` \\*e\\*: 2 pictures")) << summary;
}

}  // namespace preview_command_test
}  // namespace lagomorph::tests
