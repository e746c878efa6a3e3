/** # Files that a user names for output

They are checked first: no long run ends at a name that cannot be written. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator {

/** A file, or an empty folder, that is removed with this object, or when a signal to stop
    ends the program; it may be gone before. */
class Temporary {
public:
  explicit Temporary(std::string name);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const std::string& name() const { return name_; }

private:
  const std::string name_;
};

/** Throws BadInput for a name with control characters or bytes that are no UTF-8. */
void require_plain_name(const std::string& name);

/** Whether two names are of one file, there or not yet. */
bool is_same_file(const std::string& a, const std::string& b);

/** Throws BadInput unless `file`, the value of `option`, can be written to: none yet, in
    a folder that is there, or a regular file that this program wrote and that may be
    written, or any if `is_forced`; neither one of `inputs` nor the standard output. */
void require_writable(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs, bool is_forced);

struct NamedContent {
  std::string name, content;
};

/** Writes files beside their names, then renames them. Throws NoSolution, and leaves all
    as they were where one cannot be written. */
void write_files(const std::vector<NamedContent>& files);

/** Writes all of `text` to stdout, else throws NoSolution (a full disk, closed pipe). */
void write(const std::string& text);

}  // namespace rotor_stator
