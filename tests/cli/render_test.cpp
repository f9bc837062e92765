// The verb render: pictures, sheets, refusals.
#include <png.h>

#include <cstdint>
#include <utility>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class RenderVerb : public CliTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(Run({"synth", "--vertices", "1500", "-o", Path("s.ply"), "-q"}).exit_code, 0);
    ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  }

  // The arguments of a small picture.
  std::vector<std::string> Small(const std::string& input,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"render", Path(input), "-o",   Path("p.png"),
                                          "-f",     "--size",    "80x60"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  // Width and height of a PNG that libpng reads to its end; 0 x 0 for anything else.
  std::pair<uint32_t, uint32_t> SizeOf(const std::string& name) const {
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&header, Path(name).c_str()) == 0) return {0, 0};
    header.format = PNG_FORMAT_GA;
    std::vector<uint8_t> samples(PNG_IMAGE_SIZE(header));
    if (png_image_finish_read(&header, nullptr, samples.data(), 0, nullptr) == 0) return {0, 0};
    return {header.width, header.height};
  }

  std::string Drawn(const std::vector<std::string>& arguments) const {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return FileText(Path("p.png"));
  }
};

TEST_F(RenderVerb, WritesAPictureOfItsSize) {
  const Outcome outcome = Run(Small("s.ply", {"--json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(SizeOf("p.png"), std::pair(80U, 60U));
  const auto report = outcome.json();
  EXPECT_EQ(report.at("output"), Path("p.png"));
  EXPECT_EQ(report.at("width"), 80);
  EXPECT_EQ(report.at("height"), 60);
  EXPECT_EQ(report.at("vertices"), 1500);
  EXPECT_TRUE(report.at("warnings").empty());
  for (const char* key : {"faces", "seconds", "peak_rss_bytes"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(Files(), (std::vector<std::string>{"p.png", "s.folp", "s.ply"}));
}

TEST_F(RenderVerb, WritesTheSameBytesForEveryNumberOfThreads) {
  for (const std::vector<std::string>& flags :
       {std::vector<std::string>{}, {"--wireframe"}, {"--transparent"}, {"--layers", "2"}}) {
    std::vector<std::string> pictures;
    for (const char* threads : {"1", "2", "3"}) {
      std::vector<std::string> all = {"-T", threads};
      all.insert(all.end(), flags.begin(), flags.end());
      pictures.push_back(Drawn(Small("s.folp", all)));
    }
    EXPECT_TRUE(pictures[1] == pictures[0]);
    EXPECT_TRUE(pictures[2] == pictures[0]);
  }
}

TEST_F(RenderVerb, EachFlagChangesThePicture) {
  std::vector<std::string> pictures = {Drawn(Small("s.folp"))};
  const std::vector<std::vector<std::string>> flags = {
      {"--wireframe"}, {"--transparent"},          {"--layers", "2"},
      {"--bpv", "20"}, {"--azimuth=75"},           {"--elevation=-30"},
      {"--up", "x"},   {"--max-vertices", "1100"}, {"--max-error=100"}};
  for (const auto& flag : flags) {
    const std::string picture = Drawn(Small("s.folp", flag));
    for (const std::string& other : pictures) EXPECT_TRUE(picture != other) << flag[0];
    pictures.push_back(picture);
  }
}

TEST_F(RenderVerb, DrawsASheet) {
  const Outcome outcome = Run(Small("s.folp", {"--sheet", "--rates", "2,6", "--json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = outcome.json();
  ASSERT_EQ(report.at("pictures").size(), 3u);
  uint64_t vertices = 0;
  for (const auto& picture : report.at("pictures")) {
    EXPECT_GT(picture.at("vertices"), vertices);
    vertices = picture.at("vertices");
    for (const char* key : {"layers", "faces", "bytes", "bits_per_vertex"}) {
      EXPECT_TRUE(picture.contains(key)) << key;
    }
  }
  EXPECT_EQ(vertices, 1500u);
  const auto [width, height] = SizeOf("p.png");
  EXPECT_EQ(width, report.at("width"));
  EXPECT_EQ(height, report.at("height"));
  EXPECT_GT(width, 3 * 80U);
}

TEST_F(RenderVerb, KeepsAPictureUnlessForced) {
  WriteText(Path("old.png"), "mine");
  ExpectError({"render", Path("s.ply"), "-o", Path("old.png")}, 5, "old.png: exists already");
  EXPECT_EQ(FileText(Path("old.png")), "mine");
  ExpectError({"render", Path("s.ply"), "-f", "-o", Path("s.ply")}, 2, "is the input");
}

TEST_F(RenderVerb, RefusesWrongCalls) {
  ExpectError({"render", Path("s.ply")}, 2, "--output");
  ExpectError({"render", "-o", Path("p.png")}, 2, "FILE");
  for (const char* size : {"", "80", "80x", "x60", "80x60x2", "-80x60", "15x60", "80x8193", "a"}) {
    ExpectError({"render", Path("s.ply"), "-o", Path("p.png"), std::string("--size=") + size}, 2,
                "--size");
  }
  const std::vector<std::vector<std::string>> wrong = {{"--layers=0"},
                                                       {"--up=w"},
                                                       {"--elevation=91"},
                                                       {"--elevation=nan"},
                                                       {"--azimuth=1e9"},
                                                       {"--azimuth=nan"},
                                                       {"--bpv=0"},
                                                       {"--sheet", "--layers=2"},
                                                       {"--rates=1"},
                                                       {"--sheet", "--rates=1,,2"},
                                                       {"--bpv=1", "--layers=2"}};
  for (const auto& flags : wrong) {
    std::vector<std::string> arguments = {"render", Path("s.folp"), "-o", Path("p.png")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const std::string name = flags.back().substr(0, flags.back().find('='));
    ExpectError(arguments, 2, name);
  }
  ExpectError({"render", Path("s.folp"), "-o", Path("p.png"), "--sheet",
               "--rates=1,2,3,4,5,6,7,8,9,10,11,12"},
              2, "--rates: 12 rates");
  EXPECT_EQ(Files(), (std::vector<std::string>{"s.folp", "s.ply"}));
}

TEST_F(RenderVerb, RefusesLevelsOfAScan) {
  for (const char* flag : {"--sheet", "--layers=2", "--bpv=2", "--max-vertices=9"}) {
    ExpectError({"render", Path("s.ply"), "-o", Path("p.png"), flag}, 2, "s.ply: is no .folp file");
  }
}

TEST_F(RenderVerb, LeavesNothingAfterAFault) {
  ExpectError({"render", Path("none.ply"), "-o", Path("p.png")}, 3, "none.ply");
  WriteText(Path("cut.folp"), FileText(Path("s.folp")).substr(0, 40));
  ExpectError({"render", Path("cut.folp"), "-o", Path("p.png")}, 4, "cut.folp");
  WriteText(Path("text.ply"), "ply\nformat");
  ExpectError({"render", Path("text.ply"), "-o", Path("p.png")}, 3, "text.ply");
  ExpectError({"render", Path("s.ply"), "-o", Path("none/p.png")}, 5, "none");
  ExpectError({"render", Path("s.ply"), "-o", Path("p.png"), "-M", "100k"}, 6, "s.ply");
  EXPECT_EQ(Files(), (std::vector<std::string>{"cut.folp", "s.folp", "s.ply", "text.ply"}));
  // A disk that is full: no file may grow.
  const Outcome full =
      Wait(Start({"render", Path("s.ply"), "-o", Path("p.png"), "--size=80x60"}, 500));
  EXPECT_EQ(full.exit_code, 5) << full.err;
  EXPECT_EQ(Files(), (std::vector<std::string>{"cut.folp", "s.folp", "s.ply", "text.ply"}));
}

TEST_F(RenderVerb, DrawsWhatIsThereOfACutFile) {
  const std::string whole = FileText(Path("s.folp"));
  WriteText(Path("cut.folp"), whole.substr(0, whole.size() / 2));
  const Outcome outcome = Run(Small("cut.folp"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("cut"), std::string::npos) << outcome.err;
  const Outcome sheet = Run(Small("cut.folp", {"--sheet", "--json"}));
  EXPECT_EQ(sheet.exit_code, 0) << sheet.err;
  EXPECT_LT(sheet.json().at("pictures").back().at("vertices"), 1500);
}

TEST_F(RenderVerb, WarnsOfVerticesThatAreNotFinite) {
  WriteText(Path("nan.ply"),
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n3 0 0\n0 4 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n");
  const Outcome outcome = Run(Small("nan.ply"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("nan.ply: 1 vertex is not finite"), std::string::npos) << outcome.err;
  EXPECT_EQ(SizeOf("p.png"), std::pair(80U, 60U));
}

}  // namespace
}  // namespace folprom::cli_test
