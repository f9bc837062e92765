// --limit: what an input may ask for, by flag and by settings file.
#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class Limit : public CliTest {
 protected:
  Limit() {
    EXPECT_EQ(Run({"synth", "--vertices", "500", "-o", Path("s.ply"), "-q"}).exit_code, 0);
    EXPECT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  }
};

TEST_F(Limit, RefusesWhatIsLargerInEachVerbThatReads) {
  const std::string reason = "500 vertices are more than the limit of 100";
  const auto before = Files();
  ExpectError({"encode", Path("s.ply"), "-o", Path("t.folp"), "--limit", "vertices=100"}, 6,
              reason);
  ExpectError({"decode", Path("s.folp"), "-o", Path("t.ply"), "--limit", "vertices=100"}, 6,
              reason);
  ExpectError({"verify", Path("s.folp"), "--limit", "vertices=100"}, 6, reason);
  ExpectError({"verify", Path("s.folp"), "--against", Path("s.ply"), "--limit", "header=100"}, 6,
              "the limit of a header");
  ExpectError({"info", Path("s.folp"), "--limit", "vertices=100"}, 6, reason);
  for (const char* file : {"s.ply", "s.folp"}) {
    ExpectError({"compare", Path("s.ply"), Path(file), "--limit", "vertices=100"}, 6, reason);
    ExpectError({"render", Path(file), "-o", Path("t.png"), "--limit", "vertices=100"}, 6, reason);
  }
  ExpectError({"rd", Path("s.ply"), "-o", Path("t"), "--limit", "vertices=100"}, 6, reason);
  ExpectError({"encode", Path("s.ply"), "--estimate", "--limit", "vertices=100"}, 6, reason);
  EXPECT_EQ(Files(), before);
}

TEST_F(Limit, MayBeGivenSeveralTimesAndInEveryUnit) {
  EXPECT_EQ(Run({"decode", Path("s.folp"), "-o", Path("t.ply"), "-q", "--limit", "vertices=0.5k",
                 "--limit", "faces=1M", "--limit", "comments=2MiB"})
                .exit_code,
            0);
  ExpectError({"decode", Path("s.folp"), "-o", Path("u.ply"), "--limit", "vertices=1M", "--limit",
               "faces=3"},
              6, "faces are more than the limit of 3");
}

TEST_F(Limit, OfTheSettingsFileGivesWayToTheFlag) {
  WriteText(Path("c.toml"), "[encode]\nlimit_vertices = 100\n");
  ExpectError({"encode", Path("s.ply"), "-o", Path("t.folp"), "--config", Path("c.toml")}, 6,
              "500 vertices are more than the limit of 100");
  EXPECT_EQ(Run({"encode", Path("s.ply"), "-o", Path("t.folp"), "-q", "--config", Path("c.toml"),
                 "--limit", "vertices=500"})
                .exit_code,
            0);
}

TEST_F(Limit, RejectsUnknownNamesAndNumbers) {
  for (const std::string wrong : {"vertex=3", "vertices", "vertices=", "vertices=many", "=3"}) {
    ExpectError({"decode", Path("s.folp"), "-o", Path("t.ply"), "--limit", wrong}, 2, "--limit");
  }
  ExpectError({"decode", Path("s.folp"), "-o", Path("t.ply"), "--limit", "memory=1"}, 2,
              "vertices, faces, properties, header, comments");
}

TEST_F(Limit, RaisedKeepsLongComments) {
  std::string ply = FileText(Path("s.ply"));
  ply.insert(ply.find("element"), "comment " + std::string(100'000, 'c') + "\n");
  WriteText(Path("long.ply"), ply);
  const auto encode = [&](const std::string& limit) {
    return Run({"encode", Path("long.ply"), "-o", Path("long.folp"), "-f", "--json", "--limit",
                limit})
        .json();
  };
  EXPECT_EQ(encode("comments=64KiB").at("warnings").size(), 1u);
  EXPECT_TRUE(encode("comments=1MiB").at("warnings").empty());
  const Outcome verified =
      Run({"verify", Path("long.folp"), "--against", Path("long.ply"), "--limit", "comments=1MiB"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
}

}  // namespace
}  // namespace folprom::cli_test
