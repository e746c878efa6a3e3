#!/bin/bash
# The Debian packages that goals of make need: packages.sh install GOAL... | check GOAL...
# `check` names the missing ones and ends with status 1; on systems without dpkg it finds none.
set -eu
export LC_ALL=C
task=$1
shift
packages=()
for goal; do
  case $goal in list | clean | adopt) continue ;; esac
  [ "$goal" = format ] && packages+=(clang-format-14) && continue
  packages+=(cmake g++ git libcli11-dev libeigen3-dev libfftw3-dev libgsl-dev libtomlplusplus-dev ninja-build
    nlohmann-json3-dev pkg-config)
  case $goal in bench | fuzz | build/*) ;; *) packages+=(gnuplot-nox python3-matplotlib) ;; esac
  case $goal in all | book | article | pdf | test | test-all | sanitize | readme | dist)
    packages+=(furo libjs-mathjax pandoc python3-myst-parser python3-sphinx-copybutton python3-sphinxcontrib.bibtex) ;;
  esac
  case $goal in
    test | test-all | sanitize) packages+=(catch2 chromium chromium-driver jupyter-nbconvert python3-hypothesis
      python3-ipykernel python3-scipy python3-selenium snakemake) ;;
    clearance_speed | clearance_stiffness | stiffness_border) packages+=(snakemake) ;;
    studies | timing) packages+=(snakemake libsundials-dev python3-scipy) ;;
    hard_cases) packages+=(python3-scipy) ;;
    tab03_answers) packages+=(libsundials-dev python3-scipy) ;;
    pdf) packages+=(librsvg2-bin lmodern texlive-fonts-recommended texlive-latex-recommended texlive-luatex) ;;
    png) packages+=(librsvg2-bin) ;;
    peers) packages+=(auto-07p gfortran libsundials-dev python3-scipy) ;;
    live) packages+=(emscripten) ;;
    bench) packages+=(libbenchmark-dev) ;;
  esac
done
[ ${#packages[@]} -gt 0 ] || exit 0
mapfile -t packages < <(printf '%s\n' "${packages[@]}" | sort -u)

if command -v dpkg-query > /dev/null; then
  mapfile -t missing < <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2> /dev/null |
    sed -n 's/^installed //p' | sort | comm -13 - <(printf '%s\n' "${packages[@]}"))
else
  missing=()
fi
if [ "$task" = check ]; then
  [ ${#missing[@]} -eq 0 ] || { echo "missing: ${missing[*]} (make deps $* installs them)" >&2; exit 1; }
elif ! command -v apt-get > /dev/null; then
  echo "no apt-get here: use the Containerfile or install what these Debian packages hold: ${packages[*]}"
elif [ ${#missing[@]} -gt 0 ]; then
  sudo=
  if [ "$(id -u)" != 0 ] && command -v sudo > /dev/null; then sudo=sudo; fi
  $sudo apt-get update
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
fi
