// SPDX-License-Identifier: GPL-3.0-or-later
#include "binary.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace crackle_test {

namespace fs = std::filesystem;

const char* const good_case = R"(title = "tiny"
[domain]
width = "1 m"
height = "1 m"
[wellbore]
diameter = "0.1 m"
segments = 24
[mesh]
size_fine = "15 mm"
fine_radius = "0.12 m"
size_coarse = "0.1 m"
[rock]
density = "2500 kg/m3"
young_modulus = "35 GPa"
poisson_ratio = 0.27
tensile_strength = "1 MPa"
cohesion = "24 MPa"
friction_angle = "38 deg"
fracture_energy_mode1 = "1 J/m2"
fracture_energy_mode2 = "80 J/m2"
[cohesive]
preset = "y_geo"
calibration = "y_geo"
penalty = "120 GPa"
[stress]
xx = "-7.05 MPa"
yy = "-4.9 MPa"
[fluid]
bulk_modulus = "1.45 GPa"
[[fluid.pump]]
from = "0 s"
to = "2 ms"
rate = "130 l/s"
[run]
end_time = "0.9 ms"
)";

std::string with(const std::string& line, const std::string& instead) {
  std::string text = good_case;
  const std::size_t at = text.find(line + "\n");
  if (at == std::string::npos) throw std::logic_error("not a line of the good case: " + line);
  return text.replace(at, line.size(), instead);
}

Outcome crackle(const std::vector<std::string>& arguments, const std::string& interrupt_at) {
  const fs::path place = fs::temp_directory_path() / ("crackle_cli_" + std::to_string(getpid()));
  const std::string out = place.string() + ".out", err = place.string() + ".err";
  const pid_t child = fork();
  if (child == 0) {
    const auto send = [](int stream, const std::string& file) {
      dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    };
    send(STDOUT_FILENO, out);
    send(STDERR_FILENO, err);
    std::vector<char*> words{const_cast<char*>(CRACKLE_BINARY)};
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    execv(CRACKLE_BINARY, words.data());
    _exit(127);
  }
  int status = 0;
  if (interrupt_at.empty()) {
    waitpid(child, &status, 0);
  } else {
    while (waitpid(child, &status, WNOHANG) == 0) {
      usleep(10000);
      if (fs::exists(interrupt_at)) kill(child, SIGINT);
    }
  }
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

CliTest::CliTest() {
  std::string name = (fs::temp_directory_path() / "crackle_cli_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

CliTest::~CliTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string CliTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return path(name);
}

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::map<std::string, std::string> bytes_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    files[fs::relative(entry.path(), folder).string()] =
        entry.is_directory() ? "folder" : read_text(entry.path());
  }
  return files;
}

void expect_refusal(const Outcome& outcome, int code, const std::string& part) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_THAT(outcome.err, testing::StartsWith("crackle: "));
  EXPECT_THAT(outcome.err, testing::HasSubstr(part));
  EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << "one line:\n" << outcome.err;
}

}  // namespace crackle_test
