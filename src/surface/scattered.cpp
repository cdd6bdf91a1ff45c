#include "surface/scattered.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

namespace hexwall {
namespace {

constexpr int neighbours = 8;

double weighted_mean(const std::vector<PointValue>& values, vtkIdList* nearest, const Vec3& place) {
  double sum = 0.0;
  double weights = 0.0;
  for (vtkIdType i = 0; i < nearest->GetNumberOfIds(); ++i) {
    const PointValue& value = values[nearest->GetId(i)];
    const double distance = (value.at - place).squaredNorm();
    if (distance == 0.0) return value.value;
    sum += value.value / distance;
    weights += 1.0 / distance;
  }
  return sum / weights;
}

}  // namespace

std::vector<double> interpolate_scattered(const std::vector<PointValue>& values,
                                          const std::vector<Vec3>& places) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const PointValue& value : values) points->InsertNextPoint(value.at.data());
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> nearest;
  std::vector<double> result;
  result.reserve(places.size());
  for (const Vec3& place : places) {
    locator->FindClosestNPoints(neighbours, place.data(), nearest);
    result.push_back(weighted_mean(values, nearest, place));
  }
  return result;
}

}  // namespace hexwall
