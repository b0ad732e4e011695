#include "apps/error.h"
#include "apps/plot/run_figures.h"
#include "render/png_read.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// `lagomorph plot` as scripts see it, and the columns that it knows.
namespace lagomorph::tests {
namespace plot_command_test {

using Json = nlohmann::json;
using PlotCommand = ProgramRun;

std::vector<std::string> names_of(const std::vector<apps::NamedFigure>& figures) {
  std::vector<std::string> names;
  for (const auto& f : figures) {
    std::string name = f.name + ":";
    for (const apps::Curve& curve : f.figure.curves) name += " " + curve.name + ";";
    names.push_back(name);
  }
  return names;
}

TEST(RunFigures, PutColumnsOfOneKindTogetherAndStrangersAlone) {
  const apps::Table table = apps::read_table(
      "frame,time,kinetic,total,mass,momentum_x,momentum_y,angular_momentum_z,min_J,work_pins,strange_thing\n"
      "0,0,1,2,3,4,5,6,7,8,9\n1,0.5,1,2,3,4,5,6,7,,nan\n",
      "energy.csv");
  EXPECT_EQ(
      names_of(apps::run_figures(table, {})),
      (std::vector<std::string>{"energy: kinetic; total;", "work: work pins;",
                                "momentum: momentum x; momentum y;", "angular_momentum: angular momentum z;",
                                "determinant: min J;", "strange_thing: strange thing;"}));
  EXPECT_EQ(names_of(apps::run_figures(table, {"mass", "total"})),
            (std::vector<std::string>{"energy: total;", "mass: mass;"}));
  const apps::Figure energy = apps::run_figures(table, {"total"}).at(0).figure;
  EXPECT_EQ(energy.y.unit, "J");
  EXPECT_EQ(energy.curves[0].x, (std::vector<double>{0, 0.5}));
}

TEST(RunFigures, RefuseATableThatIsNone) {
  try {
    apps::read_table("frame,time\n0,0\n1\n", "energy.csv");
    FAIL() << "a short line passed";
  } catch (const apps::Error& e) {
    EXPECT_STREQ(e.what(), "energy.csv:3: has 1 cells; the first line names 2");
  }
}

TEST_F(PlotCommand, DrawsARun) {
  expect(0, run("run"));
  const Ended ended = run_program(Arguments{"plot", at("run").string(), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json json = Json::parse(ended.out);
  std::vector<std::string> names;
  int files = 0;
  for (const auto& figure : json["figures"]) {
    names.push_back(figure["name"]);
    for (const auto& file : figure["files"]) {
      EXPECT_GT(std::filesystem::file_size(at("run/plot") / file.get<std::string>()), 1000U) << file;
      ++files;
    }
  }
  EXPECT_EQ(count_files(at("run/plot")), files);  // and no leftovers
  EXPECT_EQ(names.front(), "energy");
  EXPECT_EQ(names.back(), "overview");
  const std::string png = read_all(at("run/plot/energy.png"));
  EXPECT_EQ(render::read_png_header(png, "energy").width, 1200);
  EXPECT_NE(read_all(at("run/plot/seconds.svg")).find(">rendering</text>"), std::string::npos);
}

TEST_F(PlotCommand, DrawsOnlyWhatIsAskedFor) {
  expect(0, run("run"));
  expect(0, Arguments{"plot", at("run").string(), "--columns", "kinetic,residual", "--format", "svg", "-o",
                      at("here").string(), "--quiet"});
  EXPECT_EQ(count_files(at("here")), 3);
  EXPECT_TRUE(std::filesystem::exists(at("here/residual.svg")));
  expect(0, Arguments{"plot", at("run").string(), "--columns", "kinetic,residual", "--format", "svg", "-o",
                      at("again").string(), "--quiet"});
  expect_same_run(at("here"), at("again"));
}

TEST_F(PlotCommand, SaysWhatIsWrong) {
  expect(0, run("run"));
  const auto refusal = [&](const Arguments& arguments) {
    const Ended ended = run_program(Arguments{"plot"} + arguments);
    EXPECT_EQ(ended.status, 2) << ended.out;
    return ended.err;
  };
  EXPECT_NE(refusal({at("run").string(), "--columns", "kinetik"}).find("did you mean 'kinetic'?"),
            std::string::npos);
  EXPECT_NE(refusal({at("run").string(), "--format", "pdf"}).find("known are svg, png"), std::string::npos);
  EXPECT_NE(refusal({at("nowhere").string()}).find("there is no such run"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("run/plot")));
}

}  // namespace plot_command_test
}  // namespace lagomorph::tests
