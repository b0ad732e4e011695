#include "apps/cli/command_line.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/version.h"

namespace lagomorph::apps {
namespace command_line_test {

CommandLine parse(const std::vector<std::string>& arguments) { return parse_command_line(arguments); }

std::string error_of(const std::vector<std::string>& arguments) {
  try {
    parse(arguments);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    return error.what();
  }
  return "no error";
}

TEST(CommandLine, TakesEveryOption) {
  const CommandLine line = parse(
      {"run",       "a.toml", "-o",        "out/a",    "--set",     "time.fps=24", "--frames",   "3..7",
       "--backend", "path",   "--threads", "2",        "--video",   "--force",     "--quiet",    "--json",
       "--every",   "4",      "--half",    "--region", "1,2,30,40", "--pattern",   "shot.##.png"});
  EXPECT_EQ(line.text, "");
  const Options& o = line.options;
  EXPECT_EQ(o.command, "run");
  EXPECT_EQ(o.inputs, std::vector<std::string>{"a.toml"});
  EXPECT_EQ(o.out, "out/a");
  EXPECT_EQ(o.set, std::vector<std::string>{"time.fps=24"});
  ASSERT_TRUE(o.frames);
  EXPECT_EQ(o.frames->first, 3);
  EXPECT_EQ(o.frames->last, 7);
  EXPECT_EQ(o.every, 4);
  EXPECT_TRUE(o.half);
  EXPECT_EQ(o.region, (std::vector<int>{1, 2, 30, 40}));
  EXPECT_EQ(o.pattern, "shot.##.png");
  EXPECT_EQ(o.backend, "path");
  EXPECT_EQ(o.threads, 2);
  EXPECT_TRUE(o.video && o.force && o.quiet && o.json);
}

TEST(CommandLine, HasDefaults) {
  const Options o = parse({"simulate", "a.toml"}).options;
  EXPECT_FALSE(o.out || o.frames || o.backend);
  EXPECT_TRUE(o.set.empty());
  EXPECT_EQ(o.threads, 0);
  EXPECT_FALSE(o.video || o.force || o.quiet || o.json || o.keys || o.mend);
}

TEST(CommandLine, TakesOptionsAnywhereAndInEachForm) {
  EXPECT_EQ(parse({"run", "--out=b", "a.toml"}).options.out, "b");
  EXPECT_EQ(parse({"run", "-ob", "a.toml"}).options.out, "b");
  EXPECT_EQ(parse({"run", "--set", "a=[1, 2]", "a.toml"}).options.set, std::vector<std::string>{"a=[1, 2]"});
  EXPECT_EQ(parse({"run", "--", "-odd.toml"}).options.inputs, std::vector<std::string>{"-odd.toml"});
  EXPECT_EQ(parse({"run", "[a]"}).options.inputs, std::vector<std::string>{"[a]"});
  EXPECT_EQ(parse({"info", "--mend", "b.msh", "a.msh"}).options.mend, "b.msh");
  EXPECT_EQ(parse({"run", "a.toml", "--backend", "null"}).options.backend, "null");
}

TEST(CommandLine, TheLastWinsAndSetAccumulates) {
  const Options o = parse({"run", "--out", "a", "--set", "x=1", "--frames", "1", "--out", "b", "s.toml",
                           "--set", "x=2", "--frames", "2", "--video", "--video"})
                        .options;
  EXPECT_EQ(o.out, "b");
  EXPECT_EQ(o.set, (std::vector<std::string>{"x=1", "x=2"}));
  EXPECT_EQ(o.frames->first, 2);
  EXPECT_TRUE(o.video);
}

TEST(CommandLine, TellsHelpAndVersion) {
  const std::string version_text = "lagomorph " + version() + "\n";
  EXPECT_EQ(parse({"--version"}).text, version_text);
  EXPECT_EQ(parse({"run", "--version"}).text, version_text);
  for (const char* help : {"-h", "--help"}) {
    EXPECT_EQ(parse({help}).text, program_help());
    EXPECT_EQ(parse({"run", help}).text.find("Usage: lagomorph run SCENE.toml [options]\n"), 0U);
    EXPECT_EQ(parse({"render", "a", "b", "--nonsense", help}).text.find("Usage: lagomorph render RUN"), 0U);
  }
  for (const char* command : {"run", "simulate", "render", "check", "approve", "compare", "info"}) {
    EXPECT_NE(program_help().find(std::string("\n  ") + command + " "), std::string::npos) << command;
    const std::string text = parse({command, "--help"}).text;
    for (const char* part : {"Options:\n", "--quiet", "--json", "\nExample: lagomorph ", "\nExit status: "}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << " of " << command;
    }
  }
  EXPECT_EQ(parse({"simulate", "--help"}).text.find("--video"), std::string::npos);
}

TEST(CommandLine, HelpFitsATerminal) {
  for (const std::string& text : {program_help(), parse({"run", "--help"}).text,
                                  parse({"check", "--help"}).text, parse({"info", "--help"}).text}) {
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
      EXPECT_LE(end - begin, 100U) << text.substr(begin, end - begin);
    }
  }
}

TEST(CommandLine, TellsWhatIsWrong) {
  const struct {
    std::vector<std::string> arguments;
    std::string message;
  } cases[] = {
      {{}, "no command given; lagomorph --help lists them"},
      {{"rnu"},
       "unknown command 'rnu'; did you mean 'run'? Commands are run, simulate, render, check, approve, "
       "preview, plot, export, compare, refine, info, material"},
      {{"publish"},
       "unknown command 'publish'; commands are run, simulate, render, check, approve, preview, plot, "
       "export, compare, "
       "refine, info, material"},
      {{"--quiet", "run"},
       "'--quiet' where a command is expected (run, simulate, render, check, approve, preview, plot, export, "
       "compare, "
       "refine, info, material); "
       "options follow "
       "the "
       "command"},
      {{"run"}, "run needs a SCENE.toml: lagomorph run SCENE.toml [options]"},
      {{"run", "a", "b"}, "unexpected argument 'b': lagomorph run SCENE.toml [options]"},
      {{"run", ""}, "SCENE.toml is empty"},
      {{"info", "--keys", "a"}, "unexpected argument 'a': lagomorph info FILE [options]"},
      {{"run", "a", "--thread", "2"}, "unknown option '--thread' of run; did you mean '--threads'?"},
      {{"run", "a", "-x"},
       "unknown option '-x' of run; known are --help, --version, --out, --set, --frames, --every, --half, "
       "--region, --pattern, --backend, --threads, --video, --codec, --static, --log-newton, --profile, "
       "--force, "
       "--quiet, --json"},
      {{"simulate", "a", "--video"}, "'--video' is no option of simulate, only of: run, render"},
      {{"run", "a", "--mend=b"}, "'--mend' is no option of run, only of: info"},
      {{"run", "a", "--out"}, "--out needs a value: --out DIR"},
      {{"run", "a", "-o"}, "--out needs a value: --out DIR"},
      {{"run", "a", "--out="}, "--out needs a value: --out DIR"},
      {{"run", "a", "--out=", "--quiet"}, "--out needs a value: --out DIR"},
      {{"export", "a", "--pattern=", "--quiet"}, "--pattern needs a value: --pattern NAME"},
      {{"run", "a", "--set=", "b"}, "--set needs a value: --set KEY=VALUE"},
      {{"run", "--frames=", "a"}, "--frames needs a value: --frames A..B"},
      {{"export", "a", "--color-frame", "1..2"}, "--color-frame 1..2: must be one frame, counted from 0"},
      {{"export", "a", "--color-frame", "x"}, "--color-frame x: must be one frame, counted from 0"},
      {{"run", "a", "--every", "0"}, "--every 0: must be a whole number, 1 or more"},
      {{"run", "a", "--every", "2x"}, "--every 2x: must be a whole number, 1 or more"},
      {{"run", "a", "--region", "0,0,9"},
       "--region 0,0,9: must be X0,Y0,X1,Y1 in pixels from the top left corner, X0 < X1, Y0 < Y1"},
      {{"run", "a", "--region", "9,0,9,4"},
       "--region 9,0,9,4: must be X0,Y0,X1,Y1 in pixels from the top left corner, X0 < X1, Y0 < Y1"},
      {{"render", "a", "--pattern", "shot.png"},
       "--pattern shot.png: must be a plain name that ends in .png, with # for the digits of the frame, as "
       "shot.####.png"},
      {{"simulate", "a", "--pattern", "#.png"},
       "'--pattern' is no option of simulate, only of: run, render, export"},
      {{"simulate", "a", "--half"}, "'--half' is no option of simulate, only of: run, render"},
      {{"run", "a", "--set", "time.fps"}, "--set time.fps: must be key.path=VALUE, as in --set time.fps=24"},
      {{"run", "a", "--backend", "vulkan"}, "--backend vulkan: unknown; known are raster, path"},
      {{"run", "a", "--threads", "0"}, "--threads 0: must be a whole number in 1 .. 1024"},
      {{"run", "a", "--threads", "-1"}, "--threads -1: must be a whole number in 1 .. 1024"},
      {{"run", "a", "--threads", "2.5"}, "--threads 2.5: must be a whole number in 1 .. 1024"},
      {{"run", "a", "--threads", "two"}, "--threads two: must be a whole number in 1 .. 1024"},
      {{"run", "a", "--threads", "99999999999"},
       "--threads 99999999999: must be a whole number in 1 .. 1024"},
      {{"compare"}, "compare needs A B: lagomorph compare A B [options]"},
      {{"compare", "a"}, "compare needs B: lagomorph compare A B [options]"},
      {{"compare", "a", "b", "c"}, "unexpected argument 'c': lagomorph compare A B [options]"},
      {{"check", "a"}, "check needs GOLDEN: lagomorph check RUN GOLDEN [options]"},
      {{"check", "a", "b", "--preset", "strict"},
       "--preset strict: unknown; known are exact, lsb, render, mc"},
      {{"check", "a", "b", "--variant", "../x"}, "--variant ../x: must be a plain name"},
      {{"compare", "a", "b", "--ppd", "0"}, "--ppd 0: must be a number in 1 .. 1000"},
      {{"compare", "a", "b", "--ppd", "nan"}, "--ppd nan: must be a number in 1 .. 1000"},
      {{"compare", "a", "b", "--ppd", "67x"}, "--ppd 67x: must be a number in 1 .. 1000"},
      {{"run", "a", "--video=perhaps"}, ""},
  };
  for (const auto& c : cases) {
    const std::string error = error_of(c.arguments);
    if (c.message.empty()) {
      EXPECT_NE(error, "no error");
    } else {
      EXPECT_EQ(error, c.message);
    }
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Frames, AreARangeOrANumber) {
  EXPECT_EQ(parse_frames("0").last, 0);
  EXPECT_EQ(parse_frames("12").first, 12);
  EXPECT_EQ(parse_frames("0..149").first, 0);
  EXPECT_EQ(parse_frames("0..149").last, 149);
  EXPECT_EQ(parse_frames("7..7").last, 7);
  for (const char* text : {"", "a", "1..", "..1", "..", "1...2", "-1", "-3..5", "1..-2", "1.5", "1..2..3",
                           " 1", "1 ", "+1", "0x1", "99999999999", "0..99999999999", "1-2", "1,2"}) {
    EXPECT_EQ(error_of({"run", "a", "--frames", text}),
              std::string("--frames ") + text + ": must be A..B or one number, counted from 0");
  }
  EXPECT_EQ(error_of({"run", "a", "--frames", "5..3"}),
            "--frames 5..3: the first frame, 5, is after the last, 3");
  EXPECT_EQ(error_of({"run", "a", "--frames=-3..5"}),
            "--frames -3..5: must be A..B or one number, counted from 0");
}

}  // namespace command_line_test
}  // namespace lagomorph::apps
