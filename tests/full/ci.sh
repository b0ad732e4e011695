#!/usr/bin/env bash
# Runs every command of assets/ci in a fresh clone, as the services do: one shell a step on GitHub, one for the job on GitLab.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[ "$(id -u)" = 0 ] || { echo "skipped: the workflows install packages; root only"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git clone -q "$root" "$work/clone"
mkdir -p "$work/clone/out"
# The compiler's cache of this machine, where there is one, in place of the one that the service would bring.
if [ -n "$(command -v ccache)" ]; then ln -s "$(ccache -k cache_dir)" "$work/clone/out/ccache"; fi
cd "$work/clone"

# The golden that assets/ci/README.md tells to make; as in a repository that uses the workflows, it is there before.
build_golden() {
  (export CCACHE_DIR=$PWD/out/ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
   # shellcheck source=apps/setup.sh
   root=$PWD; . apps/setup.sh; build release lagomorph)
  # shellcheck disable=SC2016
  PATH=$PWD/out/build/release:$PATH bash -e <(sed -n '/^```sh$/,/^```$/{/^```/d;p}' assets/ci/README.md)
  rm -rf out/ci
}

# steps FILE: the file's commands as a script a step, in $work/steps, with the variables of its top.
steps() {
  rm -rf "$work/steps"
  mkdir "$work/steps"
  python3 - "$1" "$work/steps" <<'EOF'
import shlex, sys, yaml
file, folder = sys.argv[1:]
text = yaml.safe_load(open(file))
job = text["pictures"] if "pictures" in text else text["jobs"]["pictures"]
variables = text.get("env") or job["variables"]
with open(folder + "/variables", "w") as out:
    for key, value in variables.items():
        out.write("export %s=%s\n" % (key, '"%s"' % value if "$" in value else shlex.quote(value)))
if "steps" in job:
    scripts = [step["run"] for step in job["steps"] if "run" in step]
else:
    scripts = ["\n".join(job["before_script"] + job["script"]), "\n".join(job["after_script"])]
for i, script in enumerate(scripts):
    open("%s/%02d.sh" % (folder, i), "w").write(script + "\n")
EOF
}

run_steps() {
  local step
  # shellcheck source=/dev/null
  . "$work/steps/variables"
  for step in "$work"/steps/*.sh; do
    if [ -s "$GITHUB_PATH" ]; then PATH=$(tail -n 1 "$GITHUB_PATH"):$PATH; fi
    bash --noprofile --norc -eo pipefail "$step" || fail "$step: $(cat "$step")"
  done
}

expect_made() {
  local file
  for file in check/report.json check/junit.xml preview/index.html preview/contact_sheet.png preview/summary.md; do
    [ -s "out/ci/$file" ] || fail "out/ci/$file was not made"
  done
  rm -rf out/ci
}

build_golden
export GITHUB_PATH=$work/path GITHUB_STEP_SUMMARY=$work/summary CI_PROJECT_DIR=$PWD
: >"$GITHUB_PATH"
steps assets/ci/github.yml
(run_steps)
grep -q '^## bunny: 30 of 150 frames' "$work/summary" || fail "no summary of the preview"
grep -q 'lagomorph check: ' "$work/summary" || fail "no summary of the check"
! grep -q '^!\[' "$work/summary" || fail "a picture in the summary"
expect_made
: >"$GITHUB_PATH"
steps assets/ci/gitlab.yml
(run_steps)
expect_made

# A picture that differs fails the job at its check, and leaves what tells of it.
cp golden/bunny/frames/frame_0020.png golden/bunny/frames/frame_0005.png
steps assets/ci/github.yml
if (run_steps) >"$work/log" 2>&1; then fail "a wrong picture passed"; fi
[ -s out/ci/preview/index.html ] || fail "no preview of a run that differs"
grep -q '<failure' out/ci/check/junit.xml || fail "no failure in junit.xml"
