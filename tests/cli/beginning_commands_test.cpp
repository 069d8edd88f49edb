#include <json/reader.h>
#include <json/value.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/sanitized.h"
#include "engine/results/summary_file.h"
#include "tests/cli/shell_test.h"
#include "tests/engine/scene/scene_samples.h"

/// What helps one to begin: `doctor` and `init`. BURNISH_COMMAND is the program.
namespace burnish {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class Beginning : public ShellTest {
 protected:
  Outcome burnish(const std::string& arguments, const std::string& environment = "") const {
    return shell(dir, environment + " " BURNISH_COMMAND " " + arguments);
  }

  Json::Value findings(const Outcome& outcome) const {
    Json::Value found;
    std::istringstream(outcome.out) >> found;
    return found;
  }

  static const Json::Value& named(const Json::Value& findings, const std::string& name) {
    for (const Json::Value& finding : findings)
      if (finding["name"] == name) return finding;
    throw std::runtime_error("no " + name);
  }

  std::vector<std::string> kinds() const {
    std::istringstream lines(burnish("init --list").out);
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);) names.push_back(line.substr(0, line.find(' ')));
    return names;
  }
};

using Doctor = Beginning;
using Init = Beginning;

TEST_F(Doctor, FindsWhatIsThere) {
  const Outcome outcome = burnish("doctor");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("ok       OpenGL     llvmpipe"));
  EXPECT_THAT(outcome.out, HasSubstr("DejaVuSans.ttf"));
  const Json::Value all = findings(burnish("doctor --json"));
  for (const char* name : {"program", "processor", "memory", "scratch", "BLAS", "VTK", "OpenGL", "fonts"}) {
    EXPECT_TRUE(named(all, name)["ok"].asBool()) << name;
    EXPECT_TRUE(named(all, name)["required"].asBool()) << name;
    EXPECT_FALSE(named(all, name).isMember("remedy")) << name;
  }
  EXPECT_THAT(named(all, "BLAS")["found"].asString(), StartsWith("OpenBLAS "));
  EXPECT_EQ(named(findings(burnish("doctor --json", "OPENBLAS_CORETYPE=Haswell")), "BLAS")["found"]
                .asString()
                .substr(17),
            "kernels Haswell");
}

TEST_F(Doctor, TellsWhichPagesMemoryHas) {
  std::ifstream choice("/sys/kernel/mm/transparent_hugepage/enabled");
  const std::string given{std::istreambuf_iterator<char>(choice), {}};
  const bool hasLarge = !given.empty() && given.find("[never]") == std::string::npos;
  const auto found = [&](const std::string& environment) {
    return named(findings(burnish("doctor --json", environment)), "memory")["found"].asString();
  };
  EXPECT_THAT(found("env -u GLIBC_TUNABLES"), HasSubstr(hasLarge ? "in large pages" : "in small pages"));
  EXPECT_THAT(found("GLIBC_TUNABLES=glibc.malloc.hugetlb=0"),
              HasSubstr(given.find("[always]") != std::string::npos ? "in large pages" : "in small pages"));
}

/// Those that compute or draw have their memory in large pages, unless whoever calls them has set the library's tunables.
TEST_F(Beginning, OfCommandsThatTakeMuchMemorySetsItsPages) {
  std::ofstream(dir / "scene.yaml") << samples::replaced(samples::ironing, "count: 10}", "count: 100000}");
  const auto tunables = [&](const std::string& environment, const std::string& arguments) {
    return shell(
               dir,
               "env " + environment + " MARK=1 " BURNISH_COMMAND " " + arguments +
                   " > /dev/null & process=$!; "
                   "for k in 1 2 3 4 5 6 7 8 9 10; do sleep 0.1; "
                   "tr '\\0' '\\n' < /proc/$process/environ | grep -e GLIBC_TUNABLES -e MARK && break; done; "
                   "kill -KILL $process; wait $process")
        .out;
  };
  EXPECT_EQ(tunables("-u GLIBC_TUNABLES", "run scene.yaml -o a --quiet"),
            kIsSanitized ? "MARK=1\n" : "GLIBC_TUNABLES=glibc.malloc.hugetlb=1\nMARK=1\n");
  EXPECT_EQ(tunables("GLIBC_TUNABLES=glibc.malloc.hugetlb=0", "run scene.yaml -o b --quiet"),
            "GLIBC_TUNABLES=glibc.malloc.hugetlb=0\nMARK=1\n");
  ASSERT_EQ(shell(dir, "mkfifo pipe.yaml").code, 0);  // from which nothing comes
  EXPECT_EQ(tunables("-u GLIBC_TUNABLES", "validate pipe.yaml"), "MARK=1\n");
}

TEST_F(Doctor, TellsWhatToDoAboutTheRest) {
  const Outcome without = burnish("doctor", "PATH=/nowhere");
  EXPECT_EQ(without.code, 0) << "videos are not for everyone";
  EXPECT_THAT(without.out,
              HasSubstr("missing  ffmpeg     not in PATH\n                    needed for videos"));
  EXPECT_THAT(without.out, HasSubstr("apt-get install ffmpeg"));

  std::ofstream(dir / "fonts.conf") << "<?xml version=\"1.0\"?><fontconfig></fontconfig>";
  const Outcome fontless = burnish("doctor --json", "FONTCONFIG_FILE=$PWD/fonts.conf");
  EXPECT_EQ(fontless.code, 1);
  const Json::Value found = findings(fontless);
  EXPECT_FALSE(named(found, "fonts")["ok"].asBool());
  EXPECT_THAT(named(found, "fonts")["remedy"].asString(), HasSubstr("fonts-dejavu-core"));
  EXPECT_TRUE(named(found, "OpenGL")["ok"].asBool());

  const Outcome scratchless = burnish("doctor", "TMPDIR=/nowhere");
  EXPECT_EQ(scratchless.code, 1);
  EXPECT_THAT(scratchless.out, HasSubstr("missing  scratch"));
}

TEST_F(Doctor, TellsWhyAModuleCannotBeLoaded) {
  std::ofstream(dir / "burnish_petsc.so") << "no library\n";
  const Json::Value found = named(findings(burnish("doctor --json", "LD_LIBRARY_PATH=$PWD")), "multigrid");
  EXPECT_FALSE(found["ok"].asBool());
  EXPECT_THAT(found["found"].asString(),
              AllOf(StartsWith("burnish_petsc.so, which is there but cannot be loaded: "),
                    HasSubstr("/burnish_petsc.so: file too short")));
  EXPECT_THAT(found["remedy"].asString(), StartsWith("install what it misses"));
}

TEST_F(Doctor, TellsWhichLibraryDraws) {
  const auto openGl = [&](const std::string& environment) {
    const Json::Value found = named(findings(burnish("doctor --json", environment)), "OpenGL");
    return (found["ok"].asBool() ? "ok: " : "missing: ") + found["found"].asString();
  };
  EXPECT_THAT(openGl(""), AllOf(StartsWith("ok: llvmpipe"), EndsWith(", through OSMesa")));
  EXPECT_THAT(openGl("BURNISH_GL=osmesa"), EndsWith(", through OSMesa"));
  EXPECT_THAT(openGl("BURNISH_GL=egl"), AllOf(StartsWith("ok: llvmpipe"), EndsWith(", through EGL")));
  EXPECT_EQ(openGl("BURNISH_GL=glx"),
            "missing: environment variable BURNISH_GL: found 'glx'; allowed: osmesa, egl");

  const auto spoil = [&](const char* library) { std::ofstream(dir / library) << "no library\n"; };
  spoil("libOSMesa.so.8");
  EXPECT_THAT(openGl("LD_LIBRARY_PATH=$PWD"), EndsWith(", through EGL")) << "where OSMesa is not there";
  EXPECT_THAT(openGl("LD_LIBRARY_PATH=$PWD BURNISH_GL=osmesa"),
              StartsWith("missing: libOSMesa.so.8 cannot be loaded: it is not installed"));
  spoil("libEGL.so.1");
  EXPECT_THAT(openGl("LD_LIBRARY_PATH=$PWD"), AllOf(StartsWith("missing: libOSMesa.so.8 cannot be loaded"),
                                                    HasSubstr("; and libEGL.so.1 cannot be loaded")));
}

TEST_F(Init, EveryKindIsAGoodSceneWithoutWarnings) {
  ASSERT_GE(kinds().size(), 7u);
  for (const std::string& kind : kinds()) {
    ASSERT_EQ(burnish("init " + kind + " --kind " + kind).code, 0) << kind;
    const Outcome validated = burnish("validate " + kind + ".yaml");
    EXPECT_EQ(validated.code, 0) << kind;
    EXPECT_EQ(validated.err, "") << kind;
    EXPECT_THAT(validated.out, HasSubstr(": fine (")) << kind;
  }
}

TEST_F(Init, TheFirstSceneRunsAsItIsTold) {
  const Outcome made = burnish("init 'first scene'");
  ASSERT_EQ(made.code, 0) << made.err;
  const std::size_t run = made.out.find("burnish run 'first scene.yaml'");
  ASSERT_NE(run, std::string::npos) << made.out;
  const Outcome outcome = burnish(made.out.substr(run + 8, made.out.size() - run - 9) + " --quiet");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(readSummary(dir / "out/first scene").completed);
  EXPECT_TRUE(fs::exists(dir / "out/first scene/pictures/von_mises_t1.png"));
}

TEST_F(Init, NeverOverwrites) {
  std::ofstream(dir / "mine.yaml") << "mine";
  expectRefusal(burnish("init mine"), "init mine", "mine.yaml: it is there already");
  fs::create_symlink("nowhere", dir / "link.yaml");
  expectRefusal(burnish("init link.yaml"), "init link.yaml", "link.yaml: it is there already");
  EXPECT_EQ(readText(dir / "mine.yaml"), "mine");
  EXPECT_FALSE(fs::exists(dir / "nowhere"));
  ASSERT_EQ(burnish("init deep/er/scene").code, 0);
  EXPECT_TRUE(fs::exists(dir / "deep/er/scene.yaml"));
}

TEST_F(Init, PrintsASceneThatIsComputedFromStandardInput) {
  ASSERT_EQ(burnish("init a --kind axisymmetric").code, 0);
  EXPECT_EQ(burnish("init - --kind axisymmetric").out, readText(dir / "a.yaml"));
  EXPECT_THAT(burnish("init - --kind nothing").err, HasSubstr("--kind: found \"nothing\""));
  EXPECT_EQ(burnish("info - < a.yaml").out, burnish("info a.yaml").out);
  EXPECT_EQ(burnish("info - --json < a.yaml").out, burnish("info a.yaml --json").out);
  const std::string coarse = " --quiet --set geometry.spans=[6,6] --set output.vtu=false --set pictures=[]";
  ASSERT_EQ(burnish("run a.yaml -o file" + coarse).code, 0);
  ASSERT_EQ(burnish("run - -o piped" + coarse + " < a.yaml").code, 0);
  for (const char* name : {"history.csv", "result.h5"})
    EXPECT_EQ(readText(dir / "file" / name), readText(dir / "piped" / name)) << name;
  EXPECT_FALSE(fs::exists(dir / "-.yaml"));
}

}  // namespace
}  // namespace burnish
