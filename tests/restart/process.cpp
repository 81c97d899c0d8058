// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <fstream>
#include <regex>

namespace crackle_test {

namespace fs = std::filesystem;

Process::Process(const std::vector<std::string>& arguments, const std::string& scratch,
                 const std::function<void()>& prepare)
    : out_(scratch + ".out"), err_(scratch + ".err") {
  child_ = fork();
  if (child_ != 0) return;
  const auto send = [](int stream, const std::string& file) {
    dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
  };
  send(STDOUT_FILENO, out_);
  send(STDERR_FILENO, err_);
  if (prepare) prepare();
  std::vector<char*> words{const_cast<char*>(CRACKLE_BINARY)};
  for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
  words.push_back(nullptr);
  execv(CRACKLE_BINARY, words.data());
  _exit(127);
}

Process::~Process() {
  if (!ended_) {
    signal(SIGKILL);
    wait();
  }
}

void Process::signal(int number) const {
  if (!ended_) kill(child_, number);
}

bool Process::has_ended() {
  if (!ended_) ended_ = wait4(child_, &status_, WNOHANG, &usage_) == child_;
  return ended_;
}

double Process::processor_time() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(child_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 1e9;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double Process::resident_bytes() const {
  std::ifstream file("/proc/" + std::to_string(child_) + "/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double Process::peak_memory() const { return 1024.0 * static_cast<double>(usage_.ru_maxrss); }

Outcome Process::wait() {
  if (!ended_) wait4(child_, &status_, 0, &usage_);
  ended_ = true;
  const Outcome outcome{WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, read_text(out_), read_text(err_)};
  fs::remove(out_);
  fs::remove(err_);
  return outcome;
}

bool wait_for(const std::string& file, Process& process) {
  while (!fs::exists(file)) {
    if (process.has_ended()) return fs::exists(file);
    usleep(500);
  }
  return true;
}

std::map<std::string, std::string> results(const std::string& folder) {
  std::map<std::string, std::string> files = bytes_below(folder);
  files.erase("run.log");
  files.erase("status.json");
  if (files.contains("summary.json")) {
    const std::regex wall("\"(wall_s|core_ns_per_triangle_step)\": [^,]*");
    files["summary.json"] = std::regex_replace(files["summary.json"], wall, "");
  }
  return files;
}

void expect_same_results(const std::string& folder, const std::string& reference) {
  const auto a = results(folder), b = results(reference);
  for (const auto& [name, bytes] : b) {
    const auto found = a.find(name);
    EXPECT_TRUE(found != a.end()) << name << " is missing";
    EXPECT_TRUE(found == a.end() || found->second == bytes) << name << " differs";
  }
  for (const auto& [name, bytes] : a) EXPECT_TRUE(b.contains(name)) << name << " is too many";
}

void expect_readable_frames(const std::string& folder) {
  for (const char* name : {"fields.pvd", "fractures.pvd"}) {
    if (!fs::exists(fs::path(folder) / name)) continue;
    const std::string text = read_text(fs::path(folder) / name);
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos) << name;
    const std::regex file("file=\"([^\"]*)\"");
    for (std::sregex_iterator it(text.begin(), text.end(), file), end; it != end; ++it) {
      const std::string frame = read_text(fs::path(folder) / (*it)[1].str());
      EXPECT_NE(frame.find("</VTKFile>"), std::string::npos) << (*it)[1];
    }
  }
}

}  // namespace crackle_test
