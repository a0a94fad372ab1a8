"""Weights of a PyTorch checkpoint (.pth, .pt, .ckpt) as safetensors, for `eyebolt_net::weights`.

    pip install torch safetensors numpy
    python convert_weights.py WEIGHTS.pth WEIGHTS.safetensors [PREFIX]

PREFIX, by default that of `DataParallel`, is stripped from names. Such a checkpoint is a pickle: reading it runs
what its author put there, so convert only files that you trust. What is written holds numbers alone.
"""
import sys

import torch
from safetensors.torch import save_file

if len(sys.argv) not in (3, 4):
    sys.exit(__doc__)
source, target, prefix = (*sys.argv[1:], "module.")[:3]
found = torch.load(source, map_location="cpu", weights_only=False)
for key in ("state_dict", "model"):
    found = found.get(key, found) if isinstance(found, dict) else found
found = found.state_dict() if hasattr(found, "state_dict") else found
tensors = {name.removeprefix(prefix): value.detach() for name, value in dict(found).items() if torch.is_tensor(value)}
if not tensors:
    sys.exit(f"{source}: no tensors at its top, in `state_dict` or in `model`")
single = lambda value: value.float() if value.is_floating_point() and value.element_size() > 4 else value
save_file({name: single(value).contiguous().clone() for name, value in tensors.items()}, target)
print(f"{target}: {len(tensors)} tensors")
