r"""Train a small detector on a data set of `uwsim dataset`, and score it on the test images.

    pip install torch torchvision pycocotools
    uwsim dataset visibility-scene -n 400 --size 320x240 --target blackbox --encoding jpeg \
        --format coco -o boxes
    python examples/learning/detector.py boxes

The detector is torchvision's FCOS with a small backbone and no stored weights. It reads the COCO
files of the data set; the score is COCO's average precision of boxes. The project's tests do
without torch and do not run this example.
"""

import argparse
import time
from pathlib import Path

import torch
from pycocotools.coco import COCO
from pycocotools.cocoeval import COCOeval
from torch import nn
from torchvision.io import ImageReadMode, read_image
from torchvision.models.detection import FCOS
from torchvision.models.detection.anchor_utils import AnchorGenerator

HEIGHT, WIDTH = 120, 160  # the detector makes images smaller [px]
BATCH = 8


class Backbone(nn.Sequential):
    """A row of five convolutions; a cell of the last is 8 px wide."""

    out_channels = 64

    def __init__(self):
        layers = []
        for n_in, n_out, stride in ((3, 16, 2), (16, 32, 2), (32, 64, 2), (64, 64, 1), (64, 64, 1)):
            layers += [nn.Conv2d(n_in, n_out, 3, stride, 1), nn.BatchNorm2d(n_out), nn.ReLU()]
        super().__init__(*layers)


def read_split(folder, split):
    """Read COCO's file, the images (3, h, w) from 0 to 1, and their boxes and classes."""
    truth = COCO(str(folder / "coco" / f"instances_{split}.json"))
    images, targets = [], []
    for image in truth.loadImgs(sorted(truth.imgs)):
        pixels = read_image(str(folder / image["file_name"]), ImageReadMode.RGB)
        rows = truth.loadAnns(truth.getAnnIds(image["id"]))
        boxes = torch.tensor([row["bbox"] for row in rows], dtype=torch.float32).reshape(-1, 4)
        boxes[:, 2:] += boxes[:, :2]  # right and bottom
        labels = torch.tensor([row["category_id"] for row in rows], dtype=torch.int64)
        images.append(pixels.float() / 255.0)
        targets.append({"boxes": boxes, "labels": labels})
    return truth, images, targets


def train(detector, images, targets, n_epochs):
    """Train for some passes over the images; print the mean loss of each."""
    n_steps = n_epochs * -(-len(images) // BATCH)
    optimizer = torch.optim.AdamW(detector.parameters(), lr=2e-3, weight_decay=1e-4)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, 2e-3, total_steps=n_steps)
    detector.train()
    for epoch in range(n_epochs):
        total = 0.0
        batches = torch.randperm(len(images)).split(BATCH)
        for batch in batches:
            losses = detector([images[i] for i in batch], [targets[i] for i in batch])
            loss = sum(losses.values())
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(detector.parameters(), 5.0)
            optimizer.step()
            schedule.step()
            total += loss.item()
        print(f"epoch {epoch + 1}: loss {total / len(batches):.3f}", flush=True)


def score(detector, truth, images):
    """Print COCO's average precision of the detected boxes."""
    rows = []
    detector.eval()
    with torch.no_grad():
        for id, image in zip(sorted(truth.imgs), images, strict=True):
            detections = detector([image])[0]
            columns = (detections[name].tolist() for name in ("boxes", "labels", "scores"))
            for (left, top, right, bottom), label, share in zip(*columns, strict=True):
                bbox = [left, top, right - left, bottom - top]
                rows.append({"image_id": id, "category_id": label, "bbox": bbox, "score": share})
    evaluation = COCOeval(truth, truth.loadRes(rows), "bbox")
    evaluation.evaluate()
    evaluation.accumulate()
    evaluation.summarize()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--epochs", type=int, default=12)
    arguments = parser.parse_args()
    torch.manual_seed(0)
    _, images, targets = read_split(arguments.folder, "train")
    truth, test_images, _ = read_split(arguments.folder, "test")
    anchors = AnchorGenerator(((8,),), ((1.0,),))
    n_classes = 1 + max(truth.cats)  # 0 is the background
    size = {"min_size": HEIGHT, "max_size": WIDTH}
    detector = FCOS(Backbone(), n_classes, **size, anchor_generator=anchors, score_thresh=0.02)
    start = time.process_time()
    train(detector, images, targets, arguments.epochs)
    print(f"{time.process_time() - start:.0f} s of CPU time for {arguments.epochs} epochs")
    score(detector, truth, test_images)
