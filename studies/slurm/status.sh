#!/bin/sh
# What has become of the Slurm job $1, in the words of snakemake.
case $(sacct -j "$1" --format=State --noheader --allocations | head -n 1) in
  *COMPLETED*) echo success ;;
  *PENDING* | *RUNNING* | *COMPLETING* | *CONFIGURING* | *SUSPENDED* | "") echo running ;;
  *) echo failed ;;
esac
