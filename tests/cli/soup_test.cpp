// What the program says of soups, and --weld.
#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class Soup : public CliTest {
 protected:
  Soup() { EXPECT_EQ(Run({"synth", "--vertices", "400", "-o", Path("s.stl"), "-q"}).exit_code, 0); }
};

TEST_F(Soup, IsToldByEncodeAndInfoWithBothNumbersOfVertices) {
  const Outcome encoded = Run({"encode", Path("s.stl"), "-o", Path("s.folp"), "--json"});
  ASSERT_EQ(encoded.exit_code, 0) << encoded.err;
  const auto report = encoded.json();
  EXPECT_EQ(report.at("vertices"), 400);
  EXPECT_EQ(report.at("scan_vertices"), 3 * report.at("faces").get<int>());
  EXPECT_EQ(report.at("is_soup"), true);
  const auto info = Run({"info", Path("s.folp"), "--json"}).json();
  EXPECT_EQ(info.at("vertices"), 400);
  EXPECT_EQ(info.at("scan_vertices"), report.at("scan_vertices"));
  EXPECT_NE(Run({"info", Path("s.folp")}).out.find("a soup: "), std::string::npos);
  EXPECT_EQ(Run({"verify", Path("s.folp"), "--against", Path("s.stl")}).exit_code, 0);
}

TEST_F(Soup, IsASurfaceWithTheFlagOrTheSetting) {
  WriteText(Path("c.toml"), "[encode]\nweld = true\n");
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--weld"}, {"--config", Path("c.toml")}}) {
    std::vector<std::string> arguments = {"encode", Path("s.stl"), "-o", Path("s.folp"), "-fq"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    EXPECT_EQ(Run(arguments).exit_code, 0);
    const auto info = Run({"info", Path("s.folp"), "--json"}).json();
    EXPECT_EQ(info.at("is_soup"), false);
    EXPECT_EQ(info.at("scan_vertices"), 400);
    const Outcome verified = Run({"verify", Path("s.folp"), "--against", Path("s.stl"), "--json"});
    EXPECT_EQ(verified.exit_code, 0) << verified.err;
    EXPECT_EQ(verified.json().at("welded"), true);
  }
}

}  // namespace
}  // namespace folprom::cli_test
